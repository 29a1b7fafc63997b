# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by FreeCAD: prints where its user keeps Mods, and which Python it has.

Usage: ``freecadcmd ask_freecad.py </dev/null``; lines ``TETRA name=value``.
"""

import sys
from pathlib import Path

import FreeCAD

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from freecad_tetra.workbench import child_python, compat

answers = {
    "version": ".".join(str(part) for part in compat.version()),
    "mod": compat.user_folder() / "Mod",
    "tag": f"cp{sys.version_info.major}{sys.version_info.minor}",
    "python": child_python.find(),
}
for name, value in answers.items():
    FreeCAD.Console.PrintMessage(f"\nTETRA {name}={value}\n")
