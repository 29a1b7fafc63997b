# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this at its start, with or without a window; there is nothing to register yet."""
