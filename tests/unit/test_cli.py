# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line ends with the right exit code, whole files or none, and never a traceback."""

from __future__ import annotations

import faulthandler
import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import shapes

from freecad_tetra import export
from freecad_tetra.cli import arguments, commands, supervise
from freecad_tetra.errors import MissingDependency
from freecad_tetra.model import Solid

COMMAND = [sys.executable, "-m", "freecad_tetra"]


def run(*words: object, **options: object) -> subprocess.CompletedProcess[str]:
    command = [*COMMAND, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, **options)  # type: ignore[call-overload]
    assert "Traceback" not in done.stderr, done.stderr
    return done  # type: ignore[no-any-return]


def off(folder: Path, vertices: np.ndarray, triangles: np.ndarray, name: str = "in.off") -> Path:
    rows = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    rows += [" ".join(f"{x:.17g}" for x in p) for p in vertices]
    rows += ["3 {} {} {}".format(*t) for t in triangles]
    path = folder / name
    path.write_text("\n".join(rows) + "\n")
    return path


def shape_file(folder: Path, shape: shapes.Shape) -> Path:
    return off(folder, shape.vertices, shape.triangles)


def torus(folder: Path, count: int) -> Path:
    """A bumpy torus of 2 count^2 triangles, which keeps the kernel busy."""
    u, v = np.meshgrid(*[np.arange(count)] * 2, indexing="ij")
    a, b = (2 * np.pi * x / count for x in (u, v))
    r = 3 + 0.5 * np.sin(7 * a) * np.cos(9 * b)
    points = np.stack(
        [(10 + r * np.cos(b)) * np.cos(a), (10 + r * np.cos(b)) * np.sin(a), r * np.sin(b)], axis=-1
    )

    def at(i: np.ndarray, j: np.ndarray) -> np.ndarray:
        return (i % count) * count + j % count

    low = np.stack([at(u, v), at(u + 1, v), at(u + 1, v + 1)], axis=-1)
    top = np.stack([at(u, v), at(u + 1, v + 1), at(u, v + 1)], axis=-1)
    rows = np.concatenate([low.reshape(-1, 3), top.reshape(-1, 3)])
    return export.write(Solid(points.reshape(-1, 3), rows), folder / "torus.off")


def test_cells_of_an_l_prism(tmp_path: Path) -> None:
    source = shape_file(tmp_path, shapes.l_prism())
    out, surface, report = (tmp_path / n for n in ("out.obj", "surface.off", "report.json"))
    done = run("cells", source, "-o", out, "--surface", surface, "--report", report)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert out.read_text().count("o cell_") == 2
    found = json.loads(report.read_text())
    assert found["exit_code"] == 0 and found["volume"] == pytest.approx(10)
    assert found["counts"]["notches"] == 1 and found["bounds"]["bajaj_dey"] == 2
    assert found["command"] == "cells" and found["seconds"]
    assert run("check", surface, out).returncode == 0
    assert run("check", source, out).returncode == 0
    left = sorted(p.name for p in tmp_path.iterdir())
    assert left == ["in.off", "out.obj", "report.json", "surface.off"], "no temporary files"


@pytest.mark.parametrize("suffix", [".obj", ".vtu", ".glb", ".brep"])
def test_every_format_twice_the_same(tmp_path: Path, suffix: str) -> None:
    source = shape_file(tmp_path, shapes.issue_8379())
    files = [tmp_path / f"{n}{suffix}" for n in "ab"]
    for path in files:
        assert run("cells", source, "-o", path).returncode == 0
    assert files[0].read_bytes() == files[1].read_bytes()


def test_check_rejects_cells_of_another_solid(tmp_path: Path) -> None:
    source = shape_file(tmp_path, shapes.l_prism())
    assert run("cells", source, "-o", tmp_path / "out.obj").returncode == 0
    other = off(tmp_path, shapes.cube(3).vertices, shapes.cube(3).triangles, "other.off")
    done = run("check", other, tmp_path / "out.obj", "--report", tmp_path / "r.json")
    assert done.returncode == 5 and "volume" in done.stderr
    assert json.loads((tmp_path / "r.json").read_text())["verdict"] == "unverified"
    assert run("check", other, tmp_path / "none.obj").returncode == 4


def test_info(tmp_path: Path) -> None:
    done = run("info", shape_file(tmp_path, shapes.square_frame()))
    assert done.returncode == 0
    told = dict(row.rsplit(maxsplit=1) for row in done.stdout.splitlines() if "at most" not in row)
    assert told["genus"] == "1" and told["shells"] == "1" and told["defects"] == "0"
    assert told["notches"] == "4" and float(told["volume"]) == 12
    assert "pieces at most   11 (r^2/2 + r/2 + 1)" in done.stdout


def defective() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    cube = shapes.cube()
    v, t = cube.vertices, cube.triangles
    flipped = t.copy()
    flipped[5] = flipped[5, ::-1]
    angles = np.arange(8) * 2 * np.pi / 8
    strip = []
    for a in angles:
        outward = np.array([np.cos(a), np.sin(a), 0])
        across = np.cos(a / 2) * outward + np.sin(a / 2) * np.array([0, 0, 1.0])
        strip += [4 * outward - across, 4 * outward + across]
    moebius = []
    for i in range(8):
        a, b = 2 * i, 2 * i + 1
        c, d = (a + 2, b + 2) if i < 7 else (1, 0)
        moebius += [(a, b, c), (b, d, c)]
    return {
        "open": (v, t[:-1]),
        "flipped_triangle": (v, flipped),
        "crossing_shells": (np.vstack([v, v + 1]), np.vstack([t, t + 8])),
        "flat": (v * [1, 1, 0], t),
        "moebius": (np.array(strip), np.array(moebius)),
        "nan": (np.where(v == 2, np.nan, v), t),
        "infinite": (np.where(v == 2, np.inf, v), t),
        "doubled_triangle": (v, np.vstack([t, t[:1]])),
        "no_triangle": (v, t[:0]),
    }


@pytest.mark.parametrize("name", sorted(defective()))
def test_invalid_solids(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    source = off(tmp_path, *defective()[name])
    out, report = tmp_path / "out.obj", tmp_path / "report.json"
    words = ["cells", str(source), "-o", str(out), "--report", str(report)]
    done = run(*words)
    assert done.returncode == 3, done.stderr
    found = json.loads(report.read_text())
    assert found["verdict"] == "invalid" and found["exit_code"] == 3 and found["defects"]
    lines = done.stderr.splitlines()
    assert len(lines) == len(found["defects"]) + 1, "one line each, and the error"
    assert lines[0].startswith(found["defects"][0]["kind"] + ":")
    assert not out.exists()
    if name not in ("flat", "no_triangle", "nan", "infinite"):
        assert any(d["triangles"] for d in found["defects"])
    for command in (
        ["info", str(source)],
        ["tets", str(source), "-o", str(out.with_suffix(".vtu"))],
    ):
        assert commands.run(arguments.parse(command)) == 3
        assert capsys.readouterr().err == done.stderr


def test_an_inside_out_solid_is_turned(tmp_path: Path) -> None:
    cube = shapes.cube()
    source = off(tmp_path, cube.vertices, cube.triangles[:, ::-1])
    surface = tmp_path / "surface.off"
    done = run("cells", source, "-o", tmp_path / "out.obj", "--surface", surface)
    assert done.returncode == 0 and "inside out" in done.stdout
    from freecad_tetra.io import read_mesh

    assert read_mesh(surface).volume() == 8


@pytest.mark.parametrize(
    "suffix", [".stl", ".obj", ".off", ".ply", ".step", ".brep", ".iges", ".fcstd"]
)
def test_unreadable_files(tmp_path: Path, capsys: pytest.CaptureFixture[str], suffix: str) -> None:
    source, out, report = tmp_path / f"in{suffix}", tmp_path / "out.obj", tmp_path / "r.json"
    words = ["cells", str(source), "-o", str(out), "--report", str(report)]
    for content in (None, b"", b"solid x\n", b"\x00\xff\x13garbage" * 50):
        if content is not None:
            source.write_bytes(content)
        assert commands.run(arguments.parse(words)) == 4
        stderr = capsys.readouterr().err
        assert len(stderr.splitlines()) == 1 and str(source) in stderr
        assert not out.exists()
        assert json.loads(report.read_text())["exit_code"] == 4
    assert run(*words).returncode == 4


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["unknown"],
        ["cells", "a.off"],
        ["cells", "a.off", "-o", "b.obj", "--flatness", "-1"],
        ["cells", "a.off", "-o", "b.obj", "--linear-deflection", "0"],
        ["cells", "a.off", "-o", "b.obj", "--linear-deflection", "1", "--relative-deflection", "1"],
        ["cells", "a.off", "-o", "b.obj", "--angular-deflection", "nan"],
        ["cells", "a.off", "-o", "b.obj", "--solid", "0"],
        ["cells", "a.off", "-o", "b.obj", "--method", "chazelle-palios"],
        ["tets", "a.off", "-o", "b.vtu", "--direction", "0,0,0"],
        ["tets", "a.off", "-o", "b.vtu", "--direction", "1,2"],
        ["tets", "a.off", "-o", "b.vtu", "--order", "3"],
    ],
)
def test_wrong_usage(capsys: pytest.CaptureFixture[str], words: list[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        arguments.parse(words)
    assert caught.value.code == 2 and "usage" in capsys.readouterr().err


def test_wrong_usage_of_the_program() -> None:
    assert run("unknown").returncode == 2


def test_help_and_version() -> None:
    assert run("--help").returncode == 0
    assert run("cells", "--help").returncode == 0
    assert run("--version").stdout.startswith("freecad-tetra ")


def test_options_reach_the_namespace() -> None:
    words = "tets a.off -o b.vtu --direction 1,-2,3 --order 2 --pull-off on --no-compact --solid 2"
    found = arguments.parse(words.split())
    assert found.direction == (1, -2, 3) and found.order == 2
    assert (found.pull_off, found.compact, found.solid) == ("on", "off", 2)
    words = "cells a.off -o b.obj --plain --no-merge --flatness 0 --angular-deflection 5"
    found = arguments.parse(words.split())
    assert (found.plain, found.no_merge, found.flatness, found.angular_deflection) == (
        True, True, 0, 5.0
    )  # fmt: skip


def test_outputs_are_refused_before_the_work(tmp_path: Path) -> None:
    source = shape_file(tmp_path, shapes.cube())
    for words, code in (
        (["-o", tmp_path / "none" / "out.obj"], 2),
        (["-o", tmp_path], 4),
        (["-o", tmp_path / "out.xyz"], 4),
        (["-o", tmp_path / "out.obj", "--surface", tmp_path / "s.stl"], 4),
        (["-o", tmp_path / "out.obj", "--report", tmp_path / "none" / "r.json"], 2),
    ):
        done = run("cells", source, *words)
        assert done.returncode == code, done.stderr
        assert [p.name for p in tmp_path.iterdir()] == ["in.off"]


def interrupted(command: list[object], after: float) -> tuple[int, float, str]:
    """Return (exit code, seconds to answer, stderr) of a run that gets SIGINT."""
    started = subprocess.Popen(
        [*COMMAND, *map(str, command)], stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    time.sleep(after)
    assert started.poll() is None, "it was to be interrupted while at work"
    asked = time.monotonic()
    started.send_signal(signal.SIGINT)
    code = started.wait(timeout=20)
    seconds = time.monotonic() - asked
    return code, seconds, started.communicate(timeout=60)[1]


def test_ctrl_c_in_the_kernel(tmp_path: Path) -> None:
    source, out = torus(tmp_path, 400), tmp_path / "out.obj"
    code, seconds, stderr = interrupted(["cells", source, "-o", out], 2.5)
    assert code == 130 and stderr == "cancelled\n"
    assert seconds < 0.5
    assert [p.name for p in tmp_path.iterdir()] == ["torus.off"]


def test_ctrl_c_in_opencascade(tmp_path: Path) -> None:
    pytest.importorskip("OCP", reason="cadquery-ocp is not installed")
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus
    from OCP.BRepTools import BRepTools

    source = tmp_path / "torus.brep"
    BRepTools.Write_s(BRepPrimAPI_MakeTorus(100, 30).Solid(), str(source))
    words = ["info", source, "--linear-deflection", 0.0005, "--angular-deflection", 0.1]
    code, seconds, stderr = interrupted(words, 3.0)
    assert code == 130 and stderr == "cancelled\n"
    assert seconds < 0.5


def test_an_interrupted_import_is_no_missing_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted_import(*_: object, **__: object) -> None:
        raise MissingDependency("OCP", "reading B-rep models", "cadquery-ocp")

    monkeypatch.setattr(commands.api, "validate", interrupted_import)
    words = arguments.parse(["info", str(shape_file(tmp_path, shapes.cube()))])
    assert commands.run(words, None, lambda: True) == 130
    assert capsys.readouterr().err == "cancelled\n"
    assert commands.run(words) == 4


def test_progress_only_on_a_terminal(tmp_path: Path) -> None:
    source = shape_file(tmp_path, shapes.issue_8379())
    words = [*COMMAND, "cells", str(source), "-o", str(tmp_path / "out.obj")]
    outer, inner = pty.openpty()
    try:
        done = subprocess.run(words, stderr=inner, stdout=subprocess.PIPE, timeout=60)
        os.close(inner)
        shown = os.read(outer, 65536).decode()
    finally:
        os.close(outer)
    assert done.returncode == 0 and "%" in shown
    assert shown.endswith("\r"), "the line is wiped at the end"


def test_a_closed_pipe_is_no_failure(tmp_path: Path) -> None:
    source = shape_file(tmp_path, shapes.cube())
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [*COMMAND, "info", str(source)], stdout=writing, stderr=subprocess.PIPE, text=True,
        timeout=60,
    )  # fmt: skip
    os.close(writing)
    assert done.returncode == 0 and done.stderr == ""


@pytest.mark.parametrize(("stage", "code"), [("read", 4), ("tessellate", 4), ("cut", 5)])
def test_a_crash_becomes_an_exit_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str],
    stage: str, code: int,
) -> None:  # fmt: skip
    out = tmp_path / "out.obj"

    def crash(given: object, told: object, interrupted: object) -> int:
        faulthandler.disable()
        told(stage)  # type: ignore[operator]
        export.temporary_name(out, os.getpid()).write_text("half")
        os.kill(os.getpid(), signal.SIGSEGV)
        return 0

    monkeypatch.setattr(commands, "run", crash)
    assert supervise.run(arguments.parse(["cells", "a.off", "-o", str(out)])) == code
    assert "SIGSEGV" in capfd.readouterr().err
    assert not list(tmp_path.iterdir())


def test_the_worker_dies_with_its_parent(tmp_path: Path) -> None:
    started = subprocess.Popen(
        [*COMMAND, "info", str(torus(tmp_path, 500))], stdout=subprocess.PIPE, text=True
    )
    assert started.stdout is not None
    time.sleep(1.5)
    started.kill()
    started.wait()
    asked = time.monotonic()
    assert started.stdout.read() == "", "the pipe closes when the last of both has gone"
    assert time.monotonic() - asked < 0.5


def test_out_of_memory_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(commands.api, "validate", fail)
    assert commands.run(arguments.parse(["info", str(tmp_path / "a.off")])) == 5
    assert "out of memory" in capsys.readouterr().err


def test_one_solid_of_a_mesh(tmp_path: Path) -> None:
    cube = shapes.cube(1)
    vertices = np.vstack([cube.vertices, 2 * cube.vertices + 5])
    source = off(tmp_path, vertices, np.vstack([cube.triangles, cube.triangles + 8]))
    out = tmp_path / "out.obj"
    volumes = {}
    for number in (1, 2):
        report = tmp_path / "r.json"
        done = run("cells", source, "-o", out, "--solid", number, "--report", report)
        assert done.returncode == 0, done.stderr
        volumes[number] = json.loads(report.read_text())["volume"]
    assert volumes == pytest.approx({1: 1.0, 2: 8.0})
    assert run("cells", source, "-o", out, "--solid", 3).returncode == 3
