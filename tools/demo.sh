#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Decomposes the bundled bracket, checks the result, prints a short report and draws the cells apart.
set -euo pipefail
cd "$(dirname "$0")/.."

tetra=.venv/bin/freecad-tetra
part=resources/parts/bracket.step
out=build/demo
mkdir -p "$out"

"$tetra" info "$part"
for suffix in obj vtu glb brep; do
    "$tetra" cells "$part" -o "$out/cells.$suffix" --surface "$out/surface.off" \
        --report "$out/report.json" >"$out/cells.log" 2>&1 || { cat "$out/cells.log" >&2; exit 1; }
done
"$tetra" check "$out/surface.off" "$out/cells.obj"
.venv/bin/python tools/show_report.py "$out/report.json"
.venv/bin/python -m freecad_tetra.export.picture "$out/cells.obj" -o "$out/cells.png" --explode 0.6
echo "written: $out/cells.{obj,vtu,glb,brep,png}  $out/surface.off  $out/report.json"
