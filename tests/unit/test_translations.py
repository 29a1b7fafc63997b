# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every text of FreeCAD's window is in the translations, translated, with its placeholders."""

from __future__ import annotations

import ast
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FILES = sorted(ROOT.glob("resources/translations/*.ts"))


def texts_of_code() -> set[tuple[str, str]]:
    """Return (context, text) of all calls of translate and QT_TRANSLATE_NOOP."""
    found = set()
    for path in [*ROOT.glob("freecad_tetra/workbench/**/*.py"), ROOT / "InitGui.py"]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and called(node) in ("translate", "QT_TRANSLATE_NOOP"):
                context, text = (ast.literal_eval(argument) for argument in node.args)
                found.add((context, text))
    return found


def called(node: ast.Call) -> str:
    return getattr(node.func, "id", getattr(node.func, "attr", ""))


def texts_of_form() -> set[tuple[str, str]]:
    """Return (context, text) of the preferences page."""
    form = ET.parse(ROOT / "resources/ui/preferences.ui").getroot()
    strings = [s for s in form.iter("string") if s.get("notr") != "true"]
    return {(form.findtext("class") or "", s.text or "") for s in strings}


def translations(path: Path) -> dict[tuple[str, str], ET.Element]:
    found = {}
    for context in ET.parse(path).getroot().iter("context"):
        for message in context.iter("message"):
            key = (context.findtext("name") or "", message.findtext("source") or "")
            element = message.find("translation")
            assert element is not None
            found[key] = element
    return found


def test_there_is_a_german_translation() -> None:
    assert "tetra_de.ts" in [path.name for path in FILES]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_translation_is_complete(path: Path) -> None:
    known = translations(path)
    wanted = texts_of_code() | texts_of_form()
    assert len(wanted) > 100
    assert wanted == set(known), "run tools/translate.sh"
    for (_, source), element in known.items():
        assert element.get("type") != "unfinished", source
        assert element.text, source
        placeholders = re.compile(r"\{[^}]*\}")
        assert sorted(placeholders.findall(source)) == sorted(placeholders.findall(element.text))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_compiled_translation_is_there(path: Path) -> None:
    assert path.with_suffix(".qm").stat().st_size > 1000
