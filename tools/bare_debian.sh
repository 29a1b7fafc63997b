#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Clones HEAD into a bare Debian made by debootstrap and runs make there.
#
# Usage, as root: bare_debian.sh [FOLDER [TARGET...]]   (default /tmp/bare demo test)
# FOLDER keeps the unpacked Debian in FOLDER.base, so a second run starts from bare again at once.
# DEBIAN_SUITE names another Debian than bookworm, DEBIAN_PACKAGES what FOLDER.base has from the
# start, DEBIAN_SCRIPT what is run in it after that. The machine's certificates and pip settings go
# along, for networks that have a proxy of their own.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
root=${1:-/tmp/bare}
base=$root.base
suite=${DEBIAN_SUITE:-bookworm}
targets=("${@:2}")
[[ ${#targets[@]} -gt 0 ]] || targets=(demo test)

unmount() {
    local place
    for place in "$1"/{work/shared,proc,dev/pts,dev}; do
        ! mountpoint --quiet "$place" || umount "$place"
    done
}
mount_system() {
    mount -t proc proc "$1/proc"
    mount --bind /dev "$1/dev"
    mount --bind /dev/pts "$1/dev/pts"
}
copy_settings() {
    cp /etc/resolv.conf "$1/etc/resolv.conf"
    [[ -e $1/etc/hosts ]] || printf '127.0.0.1 localhost\n::1 localhost\n' > "$1/etc/hosts"
    mkdir -p "$1/etc/ssl/certs" "$1/usr/local/share/ca-certificates"
    cp -L /usr/local/share/ca-certificates/*.crt "$1/usr/local/share/ca-certificates/" 2>/dev/null || true
    [[ ! -e /etc/pip.conf ]] || cp /etc/pip.conf "$1/etc/pip.conf"
    [[ ! -e /etc/ssl/certs/ca-certificates.crt ]] ||
        cp -L /etc/ssl/certs/ca-certificates.crt "$1/etc/ssl/certs/"
}
inside() {
    chroot "$1" /usr/bin/env -i HOME=/root LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        PIP_CERT=/etc/ssl/certs/ca-certificates.crt PIP_DEFAULT_TIMEOUT=180 "${@:2}"
}
trap 'unmount "$base"; unmount "$root"' EXIT

unmount "$base"
if [[ ! -e $base/etc/debian_version ]]; then
    debootstrap --variant=minbase "$suite" "$base" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}"
fi
if [[ -n ${DEBIAN_PACKAGES:-} && ! -e $base/var/tetra_packages ]]; then
    copy_settings "$base"
    mount_system "$base"
    inside "$base" apt-get -q update
    # shellcheck disable=SC2086  # a list of names
    inside "$base" apt-get -q install -y --no-install-recommends $DEBIAN_PACKAGES
    inside "$base" apt-get clean
    if [[ -n ${DEBIAN_SCRIPT:-} ]]; then
        cp "$DEBIAN_SCRIPT" "$base/root/script"
        inside "$base" /root/script
    fi
    touch "$base/var/tetra_packages"
    unmount "$base"
fi

unmount "$root"
rm -rf --one-file-system "$root"
cp -a "$base" "$root"
mount_system "$root"
copy_settings "$root"
mkdir -p "$root/work/shared"
git clone --quiet "$repository" "$root/work/main"
if [[ -d $repository/../shared ]]; then
    mount --bind "$repository/../shared" "$root/work/shared"
fi

# make itself is all that is asked of the machine.
inside "$root" apt-get -q update
inside "$root" apt-get -q install -y --no-install-recommends make
for target in "${targets[@]}"; do
    echo "==== make $target"
    SECONDS=0
    # shellcheck disable=SC2086  # a target, and variables of make
    inside "$root" make -C /work/main $target
    echo "==== make $target: done in $SECONDS s"
done
