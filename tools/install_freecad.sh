#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds the kernel for FreeCAD's own Python and links the checkout into the user's Mod folder.
#
# Usage: install_freecad.sh [--kernel-only]
# FREECADCMD names another program than freecadcmd.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${FREECADCMD:-freecadcmd}
command -v "$program" >/dev/null || {
    echo "there is no $program: install FreeCAD, or name its console program in FREECADCMD" >&2
    exit 1
}

told=$("$program" tools/ask_freecad.py </dev/null 2>/dev/null | tr '\r' '\n')
answer() {
    sed -n "s/^TETRA $1=//p" <<<"$told" | tail -n 1
}
tag=$(answer tag) python=$(answer python) mod=$(answer mod)
[[ -n $tag && -n $python ]] || {
    echo "$program does not tell its Python (Qt needs QT_QPA_PLATFORM=offscreen without a screen?)" >&2
    exit 1
}
echo "FreeCAD $(answer version), Python $tag: $python"

# The development build serves FreeCAD when it is for the same Python.
own=$(.venv/bin/python -c 'import sys; print("cp%d%d" % sys.version_info[:2])' 2>/dev/null || true)
if [[ $own == "$tag" ]]; then
    "${MAKE:-make}" all
else
    venv=build/freecad-venv-$tag
    [[ -x $venv/bin/python ]] || "$python" -m venv "$venv"
    "$venv/bin/python" -m pip install --quiet "$(grep '^nanobind==' tools/requirements.txt)"
    cmake -S . -B "build/freecad-$tag" -G Ninja -DTETRA_BUILD_BINDINGS=ON \
        -DPython_EXECUTABLE="$PWD/$venv/bin/python"
    cmake --build "build/freecad-$tag" --parallel "${JOBS:-2}"
fi
[[ ${1:-} != --kernel-only ]] || exit 0

mkdir -p "$mod"
place=$mod/Tetra
if [[ -e $place && ! -L $place ]]; then
    echo "$place is there already and is no link: move it away first" >&2
    exit 1
fi
ln -sfn "$PWD" "$place"
echo "linked $place; start FreeCAD and choose the workbench Tetra"
