# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands: read, work, write, and one exit code for each kind of failure."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from freecad_tetra import api, export, kernel
from freecad_tetra.cli import robot, shown
from freecad_tetra.cli.meter import Meter
from freecad_tetra.errors import (
    Cancelled,
    InvalidSolid,
    MissingDependency,
    TetraError,
    UnreadableFile,
    UnsupportedFormat,
    VerificationFailed,
)
from freecad_tetra.kernel import Validation, piece_bound
from freecad_tetra.model import ConvexCells, Report, Solid, Tet10Mesh, TetMesh

DONE, USAGE, INVALID, UNREADABLE, UNVERIFIED, CANCELLED = 0, 2, 3, 4, 5, 130
_DEFECT_LINES = 200


def run(
    arguments: argparse.Namespace,
    told: Callable[[str], None] | None = None,
    interrupted: Callable[[], bool] = lambda: False,
) -> int:
    """Run one command in this process and return its exit code; errors go to stderr.

    Parameters
    ----------
    arguments : Namespace
        From `freecad_tetra.cli.arguments.parse`.
    told : callable, optional
        ``told(stage)`` is called at every change of stage.
    interrupted : callable
        Whether the user asked to stop. Python turns an interrupt of a compiled module's
        import into an ImportError, so that no error counts once this is true.
    """
    meter = Meter(told)
    commands = {
        "tets": _tets, "cells": _cells, "info": _info, "check": _check, "quality": _quality,
        "robot": robot.write, "picture": shown.draw, "view": shown.write_page,
    }  # fmt: skip
    try:
        _require_writable(arguments)
        code = commands[arguments.command](arguments, meter)
        meter.clear()
        return code
    except KeyboardInterrupt:
        meter.clear()
        return _fail(arguments, Cancelled(), CANCELLED)
    except MemoryError:
        meter.clear()
        error = TetraError("out of memory", "a coarser deflection needs less; nothing was written")
        return _fail(arguments, error, UNVERIFIED)
    except TetraError as error:
        meter.clear()
        if interrupted():
            error = Cancelled()
        return _fail(arguments, error, exit_code(error))


def exit_code(error: TetraError) -> int:
    """Return the exit code that stands for an error."""
    if isinstance(error, InvalidSolid):
        return INVALID
    if isinstance(error, UnreadableFile | UnsupportedFormat | MissingDependency):
        return UNREADABLE
    if isinstance(error, VerificationFailed):
        return UNVERIFIED
    return CANCELLED if isinstance(error, Cancelled) else USAGE


def _fail(arguments: argparse.Namespace, error: TetraError, code: int) -> int:
    """Tell an error on stderr, one line for each defect, and in the report."""
    defects = error.defects if isinstance(error, InvalidSolid) else ()
    for defect in defects[:_DEFECT_LINES]:
        print(defect, file=sys.stderr)
    if len(defects) > _DEFECT_LINES:
        print(f"... and {len(defects) - _DEFECT_LINES} more defects", file=sys.stderr)
    print("cancelled" if code == CANCELLED else f"error: {error}", file=sys.stderr)
    if code != CANCELLED:
        verdict = {INVALID: "invalid", UNVERIFIED: "unverified"}.get(code, "failed")
        out = {"verdict": verdict, "error": type(error).__name__, "message": error.message,
               "next_step": error.next_step, "exit_code": code,
               "defects": [d.to_dict() for d in defects]}  # fmt: skip
        try:
            _write_report(arguments, out)
        except TetraError as second:
            print(f"error: {second}", file=sys.stderr)
    return code


def _require_writable(arguments: argparse.Namespace) -> None:
    """Refuse bad output names before the work and not after it."""
    order = getattr(arguments, "order", 1)
    kinds = {"cells": ConvexCells, "tets": TetMesh}
    if arguments.command in kinds:
        export.writer_for(kinds[arguments.command], arguments.output, order)
    surface = getattr(arguments, "surface", None)
    if surface:
        export.writer_for(Solid, surface)
    for name in (getattr(arguments, "output", None), surface, arguments.report):
        if name is None:
            continue
        folder = Path(name).parent
        if Path(name).is_dir() or not folder.is_dir() or not os.access(folder, os.W_OK):
            raise export.UnwritableFile(
                f"cannot write {name}", "choose a folder that exists and that you may write to"
            )


def _reading(arguments: argparse.Namespace) -> dict[str, Any]:
    names = ("linear_deflection", "relative_deflection", "angular_deflection", "solid")
    return {name: getattr(arguments, name) for name in names}


def _valid(arguments: argparse.Namespace, meter: Meter) -> Validation:
    found = api.validate(arguments.input, progress=meter, **_reading(arguments))
    if found.defects:
        raise InvalidSolid(found.defects)
    return found


def _cells(arguments: argparse.Namespace, meter: Meter) -> int:
    found = _valid(arguments, meter)
    cells = api.convex_cells(
        found,
        method=arguments.method,
        plain=arguments.plain,
        merge=not arguments.no_merge,
        flatness=arguments.flatness,
        max_cells=arguments.max_cells,
        max_vertices=arguments.max_vertices,
        progress=meter,
    )
    _write_all(arguments, meter, cells, found, cells.report)
    print(f"{len(cells)} convex cells{_summary(cells.report)}")
    return DONE


def _tets(arguments: argparse.Namespace, meter: Meter) -> int:
    analysis = bool(arguments.order == 2 or arguments.quality or arguments.refine or arguments.size)
    shape = api.shape_of(arguments.input) if analysis else None
    source = arguments.input if shape is None else shape
    found = api.validate(source, progress=meter, **_reading(arguments))
    if found.defects:
        raise InvalidSolid(found.defects)
    chosen = {name: getattr(arguments, name) for name in ("method", "direction", "pull_off",
                                                          "compact")}  # fmt: skip
    if analysis:
        mesh = api.fem_mesh(
            found,
            shape=shape,
            order=arguments.order,
            quality=arguments.quality,
            size=arguments.size or (None if arguments.quality else 0.0),
            chord=arguments.chord,
            turn=arguments.turn,
            face_sizes=dict(arguments.face_size),
            refine=arguments.refine,
            progress=meter,
            **chosen,
        )
    else:
        mesh = api.tetrahedralize(found, progress=meter, **chosen)
    _write_all(arguments, meter, mesh, found, mesh.report)
    meter.clear()
    for line in mesh.report.details.get("warnings", ()):
        print(f"warning: {line}", file=sys.stderr)
    print(f"{len(mesh)} tetrahedra, {len(mesh.points)} points{_summary(mesh.report)}")
    return DONE


def _summary(report: Report) -> str:
    parts = [f"{report.counts[k]} {k}" for k in ("facets", "notches") if k in report.counts]
    if report.method:
        parts.append(report.method)
    if "limits" in report.details:
        parts.append(f"hull error {report.details['limits']['hull_error']:.4g}")
    retries = report.details.get("surface", {}).get("retries", 0)
    if retries:
        parts.append(f"tessellated {retries} times finer")
    if report.repairs.get("turned_shells"):
        parts.append(f"{len(report.repairs['turned_shells'])} shells turned inside out")
    parts.append(f"{report.seconds.get('kernel', 0.0):.2f} s")
    return "; " + ", ".join(parts)


def _write_all(
    arguments: argparse.Namespace,
    meter: Meter,
    result: ConvexCells | TetMesh | Tet10Mesh,
    found: Validation,
    report: Report,
) -> None:
    meter("write", 0.0)
    if arguments.surface:
        tets = isinstance(result, TetMesh)
        surface = kernel.outer_surface(found, meter) if tets else found.surface()
        export.write(surface, arguments.surface)
    export.write(result, arguments.output, getattr(arguments, "order", 1))
    _write_report(arguments, {**report.to_dict(), "exit_code": DONE})


def _write_report(arguments: argparse.Namespace, out: Mapping[str, Any]) -> None:
    if arguments.report:
        full = {"command": arguments.command, "input": str(arguments.input), **out}
        with export.atomic(arguments.report) as stream:
            stream.write(json.dumps(full, indent=1).encode() + b"\n")


def _info(arguments: argparse.Namespace, meter: Meter) -> int:
    found = api.validate(arguments.input, progress=meter, **_reading(arguments))
    meter.clear()
    counts = {"vertices": len(found.solid.vertices), "facets": len(found.solid.triangles)}
    if not found.defects:  # nothing is counted in what bounds no solid
        counts.update(found.counts)
    notches = counts.get("notches")
    bounds = {} if notches is None else {"bajaj_dey": piece_bound(notches)}
    told = [(label.replace("_", " "), str(value)) for label, value in counts.items()]
    for label, value in [*told, *_info_lines(found, bounds)]:
        print(f"{label:<16} {value}")
    report = Report(
        counts=counts,
        bounds=bounds,
        volume=found.solid.volume(),
        details={"surface": dict(found.solid.notes)},
        repairs={"turned_shells": list(found.turned)},
        seconds={"validate": found.seconds},
        verdict="valid",
    )
    if found.defects:
        raise InvalidSolid(found.defects)
    if arguments.surface:
        export.write(found.surface(), arguments.surface)
    _write_report(arguments, {**report.to_dict(), "exit_code": DONE})
    return DONE


def _info_lines(found: Validation, bounds: Mapping[str, int]) -> list[tuple[str, str]]:
    solid = found.solid
    rows = [("defects", str(len(found.defects)))]
    if not found.defects:
        rows.insert(0, ("volume", f"{abs(solid.volume()):.12g}"))
    if "bajaj_dey" in bounds:
        rows.append(("pieces at most", f"{bounds['bajaj_dey']} (r^2/2 + r/2 + 1)"))
    if solid.face_names:
        rows.append(("B-rep faces", str(len(solid.face_names))))
    if solid.notes.get("brep_volume"):
        rows.append(("B-rep volume", f"{solid.notes['brep_volume']:.12g}"))
    if solid.notes.get("retries"):
        reasons = ", ".join(solid.notes["retried_for"])
        rows.append(("refined", f"{solid.notes['retries']} times ({reasons})"))
    if found.turned:
        rows.append(("turned shells", ", ".join(str(i) for i in found.turned)))
    return rows


def _check(arguments: argparse.Namespace, meter: Meter) -> int:
    found = _valid(arguments, meter)
    out = api.check(found, arguments.result, progress=meter)
    meter.clear()
    for label, value in out.items():
        print(f"{label.replace('_', ' '):<16} {value}")
    _write_report(arguments, {"verdict": "verified", **out, "exit_code": DONE})
    return DONE


def _quality(arguments: argparse.Namespace, meter: Meter) -> int:
    from freecad_tetra.cli import quality

    found = quality.measure(arguments.input)
    meter.clear()
    for line in quality.lines(found):
        print(line)
    _write_report(arguments, {"quality": found, "exit_code": DONE})
    return DONE
