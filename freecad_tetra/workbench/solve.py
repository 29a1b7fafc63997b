# SPDX-License-Identifier: LGPL-2.1-or-later
"""An analysis is solved by CalculiX, after its loads have been checked to arrive."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from freecad_tetra.errors import TetraError
from freecad_tetra.model import FloatArray
from freecad_tetra.workbench import deck, load_check


class SolverFailed(TetraError):
    """CalculiX, or what FreeCAD needs for it, has failed; the message is its own."""


@dataclass(frozen=True, eq=False)
class Solution:
    """What CalculiX found.

    Attributes
    ----------
    result : Fem::FemResultObject
        FreeCAD's own, with displacements and stresses.
    reactions : mapping of str to (3,) float64
        Force at every support, N; names of constraints in capitals. Nodes of two supports count
        in both.
    rows : list of Row
        The loads, compared.
    folder : Path
        Where deck and output are.
    """

    result: Any
    reactions: dict[str, FloatArray]
    rows: list[load_check.Row]
    folder: Path


def solve(analysis: Any, folder: str | Path | None = None, strict: bool = True) -> Solution:
    """Write the deck, check that the loads arrive, run CalculiX, load the results.

    Parameters
    ----------
    analysis : Fem::FemAnalysis
        With one solver of CalculiX, one mesh, materials and constraints.
    folder : path, optional
        For deck and output; a temporary one by default.
    strict : bool
        Stop when a load does not arrive, before the solver runs; otherwise warn.

    Raises
    ------
    LoadsLost, SolverFailed
    """
    tools, rows = _written(analysis, folder, strict)
    code = tools.ccx_run()
    if code:
        told = [line for line in tools.ccx_stdout.splitlines() if "ERROR" in line]
        raise SolverFailed(
            f"CalculiX ended with {code}: {' '.join(told[:3])}", f"see {tools.working_dir}"
        )
    tools.load_results()
    results = [m for m in analysis.Group if m.isDerivedFrom("Fem::FemResultObject")]
    if not results:
        raise SolverFailed("CalculiX gave no results", f"see {tools.working_dir}")
    data = Path(tools.inp_file_name).with_suffix(".dat")
    return Solution(results[-1], deck.reactions(data), rows, data.parent)


def write_deck(
    analysis: Any, folder: str | Path | None = None, strict: bool = True
) -> tuple[Path, list[load_check.Row]]:
    """Write the deck and check that the loads arrive; the arguments and errors of `solve`."""
    tools, rows = _written(analysis, folder, strict)
    return Path(tools.inp_file_name), rows


def _written(
    analysis: Any, folder: str | Path | None, strict: bool
) -> tuple[Any, list[load_check.Row]]:
    """Return FreeCAD's runner with its deck written, and the loads compared."""
    from femtools import ccxtools

    tools = ccxtools.FemToolsCcx(analysis, _solver(analysis))
    tools.update_objects()
    tools.setup_working_dir(str(folder or tempfile.mkdtemp(prefix="tetra_ccx_")))
    missing = tools.check_prerequisites()
    if missing:
        raise SolverFailed(missing.strip(), "complete the analysis")
    tools.purge_results()
    tools.write_inp_file()
    return tools, load_check.check(analysis, tools.inp_file_name, strict)


def _solver(analysis: Any) -> Any:
    solvers = [m for m in analysis.Group if m.isDerivedFrom("Fem::FemSolverObjectPython")]
    if len(solvers) != 1:
        raise SolverFailed(f"{analysis.Label} has {len(solvers)} solvers", "give it one CalculiX")
    return solvers[0]
