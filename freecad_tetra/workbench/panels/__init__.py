# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panels of the commands, one file each, and the parts that they are made of."""
