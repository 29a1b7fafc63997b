# SPDX-License-Identifier: LGPL-2.1-or-later
"""Methods of the results that hand them to other libraries.

Data never depends on adapters: each method looks its adapter up by name when it is called, so
that importing the model imports nothing else (docs/decisions/0005).
"""

from __future__ import annotations

import importlib
from os import PathLike
from pathlib import Path
from typing import Any


def _adapter(name: str) -> Any:
    return importlib.import_module(f"freecad_tetra.adapters.{name}")


class Conversions:
    """What convex cells and tetrahedra have in common; each call copies, O(size).

    Every method raises MissingDependency, with the pip command, when its library is missing.
    """

    def write(self, path: str | PathLike[str], order: int = 1) -> Path:
        """Write the result to a file by its suffix; see `freecad_tetra.export.write`."""
        return importlib.import_module("freecad_tetra.export").write(self, path, order)

    def to_scene(self) -> Any:
        """Return a ``trimesh.Scene``: one mesh per convex cell, or one skin per solid."""
        return _adapter("trimesh").scene(self)

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` with cell data and, of tetrahedra, a cell set per group."""
        return _adapter("meshio").mesh(self)

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.UnstructuredGrid`` with the cell data ``solid`` and ``piece``."""
        return _adapter("pyvista").grid(self)

    def to_cadquery(self) -> Any:
        """Return a ``cadquery.Compound`` with one solid per piece; neighbours share faces."""
        return _adapter("cadquery").compound(self)

    def to_build123d(self) -> Any:
        """Return a ``build123d.Compound`` with one labelled solid per piece as children."""
        return _adapter("build123d").compound(self)

    def plot(self, explode: float = 0.0, **options: Any) -> Any:
        """Show the pieces in a window of pyvista, each in a colour of its own.

        Parameters
        ----------
        explode : float
            How far the pieces move apart, as a multiple of their distance from the middle.
        **options
            Of ``pyvista.Plotter.show``, such as ``screenshot="view.png"``; and ``off_screen``.
        """
        return _adapter("pyvista").plot(self, explode, options)

    def to_html(self) -> str:
        """Return one self-contained HTML page with an interactive 3D view."""
        return str(_adapter("web").page(self))

    def _repr_html_(self) -> str:
        """Return the interactive 3D view that notebooks show."""
        return str(_adapter("web").frame(self))


class CellConversions(Conversions):
    """What only convex cells offer."""

    def to_trimesh(self) -> list[Any]:
        """Return one watertight ``trimesh.Trimesh`` per cell, as ``convex_decomposition`` does."""
        meshes: list[Any] = _adapter("trimesh").cells(self)
        return meshes

    def write_parts(self, folder: str | PathLike[str], suffix: str = ".obj") -> list[Path]:
        """Write each cell to a file of its own; see `freecad_tetra.export.parts.write_parts`."""
        return _export("parts").write_parts(self, folder, suffix)

    def write_mjcf(self, path: str | PathLike[str], **options: Any) -> Path:
        """Write a MuJoCo model; see `freecad_tetra.export.mjcf.write_mjcf`."""
        return _export("mjcf").write_mjcf(self, path, **options)

    def write_urdf(self, path: str | PathLike[str], **options: Any) -> Path:
        """Write a URDF; see `freecad_tetra.export.urdf.write_urdf`."""
        return _export("urdf").write_urdf(self, path, **options)

    def write_sdf(self, path: str | PathLike[str], **options: Any) -> Path:
        """Write an SDF; see `freecad_tetra.export.sdf.write_sdf`."""
        return _export("sdf").write_sdf(self, path, **options)


class TetConversions(Conversions):
    """What only tetrahedra offer."""

    def to_trimesh(self) -> Any:
        """Return the skin as one ``trimesh.Trimesh`` with the face attribute ``face``."""
        return _adapter("trimesh").skin(self)

    def write_drake(self, path: str | PathLike[str], **options: Any) -> Path:
        """Write an SDF of a compliant body; see `freecad_tetra.export.drake.write_drake`."""
        return _export("drake").write_drake(self, path, **options)


def _export(name: str) -> Any:
    return importlib.import_module(f"freecad_tetra.export.{name}")
