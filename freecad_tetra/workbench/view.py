# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the objects look in FreeCAD's window: view providers that show pieces in their colours.

Documents store the path of this module and the names of its classes: both are a file format.
Every piece can be picked as ``SolidN``, in the order of the pieces.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
from pivy import coin

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import compat, piece_scene, places, preferences, selection

translate = FreeCAD.Qt.translate

PIECES = "Pieces"
STYLE = ("LineColor", "LineWidth", "Transparency")


class ViewProviderPieces(compat.Stateless):
    """Shows the pieces of one object; what it holds is made anew when a document is opened.

    Attributes
    ----------
    scene : piece_scene.Scene
    mode : str
        The display mode that is on.
    """

    icon = "tetra"
    mode = PIECES

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.DisplayMode = PIECES

    def attach(self, view: Any) -> None:
        """FreeCAD calls this when the view provider gets its object."""
        self.scene = piece_scene.Scene()
        self.object = view.Object
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
        if name in STYLE and hasattr(self, "scene"):
            self._style(view)

    def onDelete(self, view: Any, elements: Any) -> bool:
        """FreeCAD calls this before the object is deleted: the solid is seen again."""
        source = getattr(view.Object, "Source", None)
        if source is not None:
            source.ViewObject.Visibility = True
        return True

    def _show(self, obj: Any) -> None:
        from freecad_tetra.workbench import feature

        self.scene.show(feature.pieces_of(obj), explosion(obj))

    def _style(self, view: Any) -> None:
        if all(name in view.PropertiesList for name in STYLE):
            lines = preferences.show_edges()
            self.scene.set_lines(lines, view.LineWidth, tuple(view.LineColor[:3]))
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
        if self.mode != PIECES or not (element.startswith("Solid") and element[5:].isdigit()):
            raise NotImplementedError
        detail = coin.SoFaceDetail()
        detail.setPartIndex(int(element[5:]) - 1)
        return detail

    def getIcon(self) -> str:
        """Return the icon of the tree."""
        return places.icon(self.icon)

    def setupContextMenu(self, view: Any, menu: Any) -> None:
        """Offer what only this object can do when it is clicked with the right button."""
        obj = view.Object
        action = menu.addAction(translate("Tetra", "Make solids of the pieces"))
        action.setEnabled(not obj.Shape.Solids)
        action.triggered.connect(lambda *checked: make_solids(obj))

    def claimChildren(self) -> list[Any]:
        """Return what the tree shows below the object: the solid that it is made of."""
        source = getattr(self.object, "Source", None)
        return [source] if source is not None else []

    def setEdit(self, view: Any, mode: int) -> bool:
        """Open the task panel on a double click."""
        import FreeCADGui

        from freecad_tetra.workbench.panels import decompose

        obj = view.Object
        if mode != 0 or obj.Source is None:
            return False
        FreeCADGui.Control.showDialog(decompose.Decompose(selection.kind_of(obj), obj.Source, obj))
        return True

    def unsetEdit(self, view: Any, mode: int) -> bool:
        """Close the task panel."""
        import FreeCADGui

        FreeCADGui.Control.closeDialog()
        return True


class ViewProviderTetrahedra(ViewProviderPieces):
    """Shows tetrahedra."""

    icon = "Tetra_Tetrahedralize"


class ViewProviderConvexCells(ViewProviderPieces):
    """Shows convex cells."""

    icon = "Tetra_ConvexCells"


def make_solids(obj: Any) -> None:
    """Give an object that is only drawn its solids, as one step that can be undone."""
    from freecad_tetra.workbench import feature, messages

    obj.Document.openTransaction(translate("Tetra", "Make solids of the pieces"))
    try:
        feature.make_compound(obj)
    except TetraError as error:
        obj.Document.abortTransaction()
        messages.show_error(error)
        return
    obj.Document.commitTransaction()


def explosion(obj: Any) -> float:
    """Return by which factor the pieces are drawn apart."""
    return float(getattr(obj, "Explode", 0.0))
