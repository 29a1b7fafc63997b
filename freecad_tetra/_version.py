# SPDX-License-Identifier: LGPL-2.1-or-later
"""The version, in the one place that all others read (pyproject.toml, CMakeLists.txt)."""

__version__ = "0.1.0"
