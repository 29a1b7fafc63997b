#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Brings the translations of the workbench up to date with its texts, and compiles them.
# New texts get into resources/translations/*.ts as unfinished: translate them there (Qt Linguist
# or an editor) and run this again. FreeCAD reads the .qm files.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/install_debian.sh qt6-l10n-tools

tools=/usr/lib/qt6/bin
mapfile -t sources < <(git ls-files InitGui.py resources/ui 'freecad_tetra/workbench/*.py')
for language in de; do
    file=resources/translations/tetra_$language.ts
    "$tools/lupdate" -silent -locations none -no-obsolete -source-language en \
        -target-language "$language" "${sources[@]}" -ts "$file"
    "$tools/lrelease" -silent "$file"
    ! grep -n 'type="unfinished"' "$file"
done
