# SPDX-License-Identifier: LGPL-2.1-or-later
"""The compiled module is found where it lies, and what is no kernel is passed by."""

from __future__ import annotations

import importlib.machinery
import shutil
import sys
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


def test_a_wheel_among_the_packages_is_brought_in(kernel: Path, tmp_path: Path) -> None:
    path = list(sys.path)
    shutil.copy(kernel, tmp_path / NAME)
    module = kernel_file.bring_in([tmp_path])
    assert module is not None and module.__file__ == str(tmp_path / NAME)
    assert kernel_file.version_of(module) == __version__
    assert sys.modules[kernel_file.MODULE] is module
    assert sys.path == path


def test_what_does_not_load_is_passed_by(kernel: Path, tmp_path: Path) -> None:
    broken, good = tmp_path / "broken", tmp_path / "good"
    for place in (broken, good):
        place.mkdir()
    (broken / NAME).write_bytes(b"no library")
    shutil.copy(kernel, good / NAME)
    assert kernel_file.load(broken / NAME) is None
    module = kernel_file.bring_in([broken, good])
    assert module is not None and module.__file__ == str(good / NAME)


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
