#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Clones HEAD into a bare Debian 12 made by debootstrap and runs make there.
#
# Usage, as root: bare_debian.sh [FOLDER [TARGET...]]   (default /tmp/bare demo test)
# FOLDER keeps the unpacked Debian in FOLDER.base, so a second run starts from bare again at once.
# The machine's certificates and pip settings go along, for networks that have a proxy of their own.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
root=${1:-/tmp/bare}
targets=("${@:2}")
[[ ${#targets[@]} -gt 0 ]] || targets=(demo test)

if [[ ! -e $root.base/etc/debian_version ]]; then
    debootstrap --variant=minbase bookworm "$root.base" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}"
fi

mounted() { mountpoint --quiet "$1"; }
unmount() {
    for place in work/shared proc dev/pts dev; do
        mounted "$root/$place" && umount "$root/$place"
    done
    return 0
}
unmount
rm -rf --one-file-system "$root"
cp -a "$root.base" "$root"
trap unmount EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"

cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir -p "$root/etc/ssl/certs" "$root/work/shared" "$root/usr/local/share/ca-certificates"
cp -L /usr/local/share/ca-certificates/*.crt "$root/usr/local/share/ca-certificates/" 2>/dev/null || true
[[ ! -e /etc/pip.conf ]] || cp /etc/pip.conf "$root/etc/pip.conf"
[[ ! -e /etc/ssl/certs/ca-certificates.crt ]] ||
    cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"

git clone --quiet "$repository" "$root/work/main"
if [[ -d $repository/../shared ]]; then
    mount --bind "$repository/../shared" "$root/work/shared"
fi

# make itself is all that is asked of the machine.
in_bare() {
    chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        PIP_CERT=/etc/ssl/certs/ca-certificates.crt PIP_DEFAULT_TIMEOUT=180 "$@"
}
in_bare apt-get -q update
in_bare apt-get -q install -y --no-install-recommends make
for target in "${targets[@]}"; do
    echo "==== make $target"
    SECONDS=0
    in_bare make -C /work/main "$target"
    echo "==== make $target: done in $SECONDS s"
done
