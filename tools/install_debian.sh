#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs the Debian packages that build, tests and demo need; wants root only for missing ones.
#
# Usage: install_debian.sh [PACKAGE...]   (without arguments the list below)
set -euo pipefail

packages=(
    build-essential cmake ninja-build git util-linux ca-certificates
    python3 python3-dev python3-venv
    libgtest-dev clang-format
    # Tests look at the HTML view in the one, and run a macro in the other.
    chromium chromium-driver freecad
    calculix-ccx  # solves the benchmarks of meshes for analysis
    # Shared libraries that cadquery-ocp and gmsh load at run time.
    libgl1 libglu1-mesa libxrender1 libxcursor1 libxft2 libxinerama1 libxfixes3 libxext6 libsm6
    libice6 libfontconfig1 libgomp1
)
[[ $# -eq 0 ]] || packages=("$@")

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null || true)
    [[ $status == "install ok installed" ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null || { echo "need root to install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing Debian packages: ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}"
