# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this at its start, with or without a window; it names the tests of the workbench."""

import FreeCAD

FreeCAD.__unit_test__ += ["freecad_tetra.workbench.selftest"]
