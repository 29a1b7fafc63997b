# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Report: counts, bounds, volumes and quality of an object's pieces."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.workbench import compat, facts
from freecad_tetra.workbench.panels import histogram
from freecad_tetra.workbench.panels.facts_box import number
from freecad_tetra.workbench.panels.forms import close_only, new_form

translate = FreeCAD.Qt.translate


class Report:
    """Shows what `facts.report` tells; the document is not touched."""

    def __init__(self, result: Any) -> None:
        FreeCADGui.Selection.clearSelection()  # its colour would hide those of the pieces
        self.report = facts.report(result)
        self.rows = rows(self.report)
        self.form = self._layout(result.Label)

    def _layout(self, label: str) -> Any:
        _, _, widgets = compat.qt()
        form = new_form(translate("Tetra", "Report"), "Tetra_Report")
        column = widgets.QVBoxLayout(form)
        column.addWidget(self._table(widgets, label))
        for title, counts, bounds in histograms(self.report.get("quality") or {}):
            column.addWidget(widgets.QLabel(title))
            chart = widgets.QLabel()
            chart.setPixmap(histogram.picture(counts, bounds, form.palette()))
            column.addWidget(chart)
        copy = widgets.QPushButton(translate("Tetra", "Copy"))
        copy.setObjectName("TetraCopy")
        copy.clicked.connect(self.copy)
        column.addWidget(copy)
        return form

    def _table(self, widgets: Any, label: str) -> Any:
        group = widgets.QGroupBox(label)
        group.setObjectName("TetraFigures")
        form = widgets.QFormLayout(group)
        for title, text in self.rows:
            form.addRow(title, widgets.QLabel(text))
        return group

    def getStandardButtons(self) -> int:
        """FreeCAD asks which buttons to show above the panel."""
        return close_only()

    def reject(self) -> bool:
        """FreeCAD calls this for Close and Esc."""
        FreeCADGui.Control.closeDialog()
        return True

    def copy(self) -> None:
        """Put the figures on the clipboard, one in a line, apart by tabs."""
        _, _, widgets = compat.qt()
        text = "\n".join(f"{title}\t{value}" for title, value in self.rows)
        widgets.QApplication.clipboard().setText(text)


def rows(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return (title, text) of the figures to show; those that are not there are left out."""
    counts, quality = report.get("counts") or {}, report.get("quality") or {}
    bound = (report.get("bounds") or {}).get("bajaj_dey") if "pieces" in counts else None
    steiner = [
        v for k, v in counts.items() if k in ("steiner_edge", "steiner_facet", "steiner_inner")
    ]
    pieces = counts.get("tets", counts.get("pieces"))
    found = [
        (translate("Tetra", "Method"), report.get("method")),
        (translate("Tetra", "Direction"), report.get("direction")),
        (translate("Tetra", "Pieces"), _count(pieces)),
        (translate("Tetra", "Pieces at most"), _count(bound)),
        (translate("Tetra", "Notches"), _count(counts.get("notches"))),
        (translate("Tetra", "Triangles"), _count(counts.get("triangles"))),
        (translate("Tetra", "Points"), _count(counts.get("points"))),
        (translate("Tetra", "Steiner points"), _count(sum(steiner) if steiner else None)),
        (translate("Tetra", "Volume"), volume(report.get("volume"))),
        (translate("Tetra", "Volume error"), _float(report.get("volume_error"), "{:.1e}")),
        (translate("Tetra", "Smallest angle"), _angle(quality.get("min_dihedral"))),
        (translate("Tetra", "Largest angle"), _angle(quality.get("max_dihedral"))),
        (translate("Tetra", "Mean ratio"), _float(quality.get("mean_ratio"), "{:.2f}")),
        (translate("Tetra", "Verdict"), verdict(report.get("verdict"))),
    ]
    return [(title, text) for title, text in found if text]


def histograms(quality: Mapping[str, Any]) -> list[tuple[str, list[int], list[float]]]:
    """Return (title, counts, bounds) of the histograms that a report holds."""
    known = [
        ("dihedral_histogram", translate("Tetra", "Smallest angles in degrees")),
        ("histogram", translate("Tetra", "Mean ratios, 1 is regular")),
    ]
    return [
        (title, quality[name], quality[name + "_bounds"])
        for name, title in known
        if name in quality
    ]


def volume(value: float | None) -> str:
    """Return a volume in mm³; FreeCAD's own choice of unit would be millilitres."""
    return _float(value, "{:.7g} mm³")


def verdict(value: str | None) -> str:
    """Return the kernel's verdict in the user's language."""
    return translate("Tetra", "verified") if value == "verified" else (value or "")


def _count(value: int | None) -> str:
    return "" if value is None else number(value)


def _float(value: float | None, form: str) -> str:
    return "" if value is None else form.format(value)


def _angle(radians: float | None) -> str:
    return "" if radians is None else f"{math.degrees(radians):.2f} °"
