# SPDX-License-Identifier: LGPL-2.1-or-later
"""The FreeCAD workbench: parametric objects, the work in a child process, compounds.

Documents store the path of `freecad_tetra.workbench.feature`; it is never renamed. Importing
this package loads neither numpy nor the kernel's compiled module.
"""
