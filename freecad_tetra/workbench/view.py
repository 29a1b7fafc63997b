# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the objects look in FreeCAD's window: view providers that show pieces in their colours.

Documents store the path of this module and the names of its classes: both are a file format.
Every piece can be picked as ``SolidN``, in the order of the pieces.
"""

from __future__ import annotations

from typing import Any

from pivy import coin

from freecad_tetra.workbench import compat, piece_scene, places, selection

PIECES = "Pieces"


class ViewProviderPieces(compat.Stateless):
    """Shows the pieces of one object; the scene is made anew when a document is opened."""

    icon = "tetra"
    mode = PIECES

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.DisplayMode = PIECES

    def attach(self, view: Any) -> None:
        """FreeCAD calls this when the view provider gets its object."""
        self.scene = piece_scene.Scene()
        view.addDisplayMode(self.scene.root, PIECES)
        self._style(view)
        self._show(view.Object)

    def updateData(self, obj: Any, name: str) -> None:
        """FreeCAD calls this after a change of the object's data."""
        if name == "Explode":
            self.scene.explode(explosion(obj))
        elif name == "Shape":
            self._show(obj)

    def onChanged(self, view: Any, name: str) -> None:
        """FreeCAD calls this after a change of how the object looks."""
        if name in ("LineColor", "LineWidth", "Transparency") and hasattr(self, "scene"):
            self._style(view)

    def _show(self, obj: Any) -> None:
        from freecad_tetra.workbench import feature

        self.scene.show(feature.pieces_of(obj), explosion(obj))

    def _style(self, view: Any) -> None:
        names = view.PropertiesList
        if "LineColor" in names and "LineWidth" in names:
            self.scene.set_lines(True, view.LineWidth, tuple(view.LineColor[:3]))
        if "Transparency" in names:
            self.scene.set_transparency(view.Transparency / 100.0)

    def getDisplayModes(self, view: Any) -> list[str]:
        """Return the modes beside those of Part."""
        return [PIECES]

    def getDefaultDisplayMode(self) -> str:
        """Return the mode of a new object."""
        return PIECES

    def setDisplayMode(self, mode: str) -> str:
        """Return the name under which a mode's nodes were added."""
        self.mode = mode
        return mode

    def getElement(self, detail: Any) -> str:
        """Return the name of a picked piece; Part knows the elements of its own modes."""
        if self.mode != PIECES or detail.getTypeId() != coin.SoFaceDetail.getClassTypeId():
            raise NotImplementedError
        return f"Solid{coin.cast(detail, 'SoFaceDetail').getPartIndex() + 1}"

    def getDetail(self, element: str) -> Any:
        """Return what to highlight for the name of a piece."""
        if not element.startswith("Solid") or not element[5:].isdigit():
            raise NotImplementedError
        detail = coin.SoFaceDetail()
        detail.setPartIndex(int(element[5:]) - 1)
        return detail

    def getIcon(self) -> str:
        """Return the icon of the tree."""
        return places.icon(self.icon)

    def claimChildren(self) -> list[Any]:
        """Return what the tree shows below the object: the solid that it is made of."""
        source = getattr(self.object, "Source", None)
        return [source] if source is not None else []
