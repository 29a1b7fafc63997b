# SPDX-License-Identifier: LGPL-2.1-or-later
"""The compiled module is found where it lies, and what is no kernel is passed by."""

from __future__ import annotations

import importlib.machinery
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from types import ModuleType

import pytest

from freecad_tetra import __version__, kernel_file

pytest.importorskip("_tetra_kernel", reason="the kernel is not built")

SUFFIX = importlib.machinery.EXTENSION_SUFFIXES[0]
NAME = kernel_file.MODULE + SUFFIX


@pytest.fixture
def kernel(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """The real module's file; nothing is loaded, and the checkout is an empty folder."""
    module = sys.modules[kernel_file.MODULE]
    monkeypatch.delitem(sys.modules, kernel_file.MODULE)
    monkeypatch.setattr(kernel_file, "ROOT", tmp_path / "checkout")
    assert module.__file__ is not None
    return Path(module.__file__)


def test_places_in_their_order(kernel: Path, tmp_path: Path) -> None:
    root, packages = tmp_path / "checkout", tmp_path / "packages"
    tag = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
    places = [root / "build/x/kernel/bindings", root / ".venv" / tag, packages]
    for place in reversed(places):
        place.mkdir(parents=True)
        (place / NAME).write_bytes(b"")
    (packages / (kernel_file.MODULE + ".cpython-27-other.so")).write_bytes(b"")
    assert kernel_file.candidates([packages]) == [place / NAME for place in places]


def in_another_process(code: str, *places: Path) -> None:
    """Run it there: in one process, two copies of a module raise each other's exceptions."""
    head = """
import sys
from pathlib import Path
from freecad_tetra import __version__, kernel_file
kernel_file.ROOT, *places = map(Path, sys.argv[1:])
"""
    arguments = map(str, [places[0] / "checkout", *places])
    done = subprocess.run(
        [sys.executable, "-c", head + textwrap.dedent(code), *arguments],
        capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def test_a_wheel_among_the_packages_is_brought_in(kernel: Path, tmp_path: Path) -> None:
    shutil.copy(kernel, tmp_path / NAME)
    code = f"""
        path = list(sys.path)
        module = kernel_file.bring_in(places)
        assert module.__file__ == str(places[0] / "{NAME}"), module.__file__
        assert kernel_file.version_of(module) == __version__
        assert sys.modules[kernel_file.MODULE] is module
        assert sys.path == path
        """
    in_another_process(code, tmp_path)


def test_what_does_not_load_is_passed_by(kernel: Path, tmp_path: Path) -> None:
    broken, good = tmp_path / "broken", tmp_path / "good"
    for place in (broken, good):
        place.mkdir()
    (broken / NAME).write_bytes(b"no library")
    shutil.copy(kernel, good / NAME)
    code = f"""
        assert kernel_file.load(places[0] / "{NAME}") is None
        module = kernel_file.bring_in(places)
        assert module.__file__ == str(places[1] / "{NAME}"), module.__file__
        """
    in_another_process(code, broken, good)


def test_another_version_is_the_last_resort(
    kernel: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old, new = ModuleType(kernel_file.MODULE), ModuleType(kernel_file.MODULE)
    old.version = lambda: "0.0.1"  # type: ignore[attr-defined]
    new.version = lambda: __version__  # type: ignore[attr-defined]
    files = {tmp_path / "a": old, tmp_path / "b": new}
    monkeypatch.setattr(kernel_file, "candidates", lambda folders: list(files))
    monkeypatch.setattr(kernel_file, "load", files.get)
    assert kernel_file.bring_in() is new
    monkeypatch.delitem(sys.modules, kernel_file.MODULE)
    monkeypatch.setattr(kernel_file, "_import", lambda: None)
    files.pop(tmp_path / "b")
    assert kernel_file.bring_in() is old
