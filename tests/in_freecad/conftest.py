# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keeps pytest away: these tests run inside FreeCAD, by unittest (run_headless, run_gui)."""

collect_ignore_glob = ["*"]
