# SPDX-License-Identifier: LGPL-2.1-or-later
"""STEP, BREP, IGES and FCStd files become one OpenCascade shape in mm."""

from __future__ import annotations

import re
import tempfile
import zipfile
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
from OCP.BRepTools import BRepTools
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESControl import IGESControl_Reader
from OCP.Message import Message, Message_Gravity, Message_PrinterOStream
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Shape

from freecad_tetra.errors import UnreadableFile, UnsupportedFormat

_BREP_END = re.compile(rb"\*\s*[+-]\d+\s+\d+\s")  # the shape itself, after the last of its parts


def read_shape(path: str | PathLike[str]) -> Any:
    """Read one file by its suffix; see `freecad_tetra.brep.read_shape`."""
    file = Path(path)
    suffix = file.suffix.lower()
    reader = _READERS.get(suffix)
    if reader is None:
        raise UnsupportedFormat(
            f"{file}: suffix {suffix or '(none)'} is no B-rep format",
            "use .step .stp .brep .iges or .fcstd",
        )
    try:
        size = file.stat().st_size
        with file.open("rb") as stream:
            head = stream.read(512)
    except OSError as error:
        raise UnreadableFile(file, error.strerror or str(error)) from error
    if size == 0:
        raise UnreadableFile(file, "the file is empty")
    _quiet()
    try:
        shape = reader(file, head)
    except (UnreadableFile, UnsupportedFormat):
        raise
    except Exception as error:  # OCP raises Standard_Failure and std::exception alike
        raise UnreadableFile(file, f"OpenCascade failed: {_one_line(error)}") from error
    if shape is None or shape.IsNull():
        raise UnreadableFile(file, "it holds no shape")
    return shape


def compound(shapes: Sequence[Any]) -> Any:
    """Return one compound of several shapes, or the one shape itself."""
    if len(shapes) == 1:
        return shapes[0]
    builder, result = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def _quiet() -> None:
    """Stop OpenCascade from writing to stdout; errors come as exceptions."""
    messenger = Message.DefaultMessenger_s()
    messenger.RemovePrinters(Message_PrinterOStream.get_type_descriptor_s())
    for printer in messenger.Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text[:200] or type(error).__name__


def _step(file: Path, head: bytes) -> Any:
    if b"ISO-10303-21" not in head:
        raise UnreadableFile(file, "it does not begin with ISO-10303-21")
    if b"END-ISO-10303-21" not in _tail(file):
        raise UnreadableFile(file, "it is truncated (END-ISO-10303-21 is missing)")
    reader = STEPControl_Reader()
    if reader.ReadFile(str(file)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise UnreadableFile(file, "OpenCascade cannot parse it as STEP")
    if reader.TransferRoots() == 0 and reader.NbShapes() == 0:
        raise UnreadableFile(file, "it holds no shape")
    return reader.OneShape()


def _tail(file: Path, count: int = 4096) -> bytes:
    with file.open("rb") as stream:
        stream.seek(0, 2)
        stream.seek(max(0, stream.tell() - count))
        return stream.read()


def _iges(file: Path, head: bytes) -> Any:
    if len(head) < 80 or head[72:73] not in (b"S", b"C"):
        raise UnreadableFile(file, "it has no IGES start section")
    reader = IGESControl_Reader()
    if reader.ReadFile(str(file)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise UnreadableFile(file, "OpenCascade cannot parse it as IGES")
    reader.TransferRoots()
    if reader.NbShapes() == 0:
        raise UnreadableFile(file, "it holds no shape")
    shape = reader.OneShape()
    has_solid = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID).More()
    return shape if has_solid else _sew(shape)


def _sew(shape: Any) -> Any:
    """Sew loose trimmed surfaces, which is all most IGES files hold, into solids."""
    sewing = BRepBuilderAPI_Sewing(1e-3)
    sewing.Add(shape)
    sewing.Perform()
    sewn = sewing.SewedShape()
    solids = []
    explorer = TopExp_Explorer(sewn, TopAbs_ShapeEnum.TopAbs_SHELL)
    while explorer.More():
        shell = TopoDS.Shell_s(explorer.Current())
        if shell.Closed():
            solids.append(BRepBuilderAPI_MakeSolid(shell).Solid())
        explorer.Next()
    return compound(solids) if solids else sewn


def _brep(file: Path, head: bytes) -> Any:
    binary = b"Open CASCADE Topology V" in head
    if not binary and b"CASCADE Topology V" not in head and b"DBRep_DrawableShape" not in head:
        raise UnreadableFile(file, "it is not an OpenCascade BREP file")
    if binary:
        return _brep_binary(file)
    if not _BREP_END.search(_tail(file)):  # OpenCascade would read on at the end for ever
        raise UnreadableFile(file, "it is truncated (the last line names no shape)")
    builder, shape = BRep_Builder(), TopoDS_Shape()
    if not BRepTools.Read_s(shape, str(file), builder):
        raise UnreadableFile(file, "OpenCascade cannot parse it as BREP")
    return shape


def _brep_binary(file: Path) -> Any:
    from OCP.BinTools import BinTools

    shape = TopoDS_Shape()
    if not BinTools.Read_s(shape, str(file)):
        raise UnreadableFile(file, "OpenCascade cannot parse it as binary BREP")
    return shape


def _fcstd(file: Path, head: bytes) -> Any:
    try:
        with zipfile.ZipFile(file) as archive, tempfile.TemporaryDirectory() as folder:
            members = _visible_members(archive)
            if not members:
                raise UnreadableFile(file, "the document holds no shape")
            shapes = []
            for number, member in enumerate(members):
                copy = Path(folder) / f"{number}.brep"
                copy.write_bytes(archive.read(member))
                with copy.open("rb") as stream:
                    shapes.append(_brep(copy, stream.read(512)))
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, RuntimeError) as error:
        raise UnreadableFile(file, f"it is not a FreeCAD document: {error}") from error
    solid = TopAbs_ShapeEnum.TopAbs_SOLID
    return compound([s for s in shapes if TopExp_Explorer(s, solid).More()] or shapes)


def _visible_members(archive: zipfile.ZipFile) -> list[str]:
    """Return the .brp members of the objects that a user sees, all of them when unknown.

    A document stores each intermediate feature; features inside a visible Body are left
    out, because the Body repeats the last of them.
    """
    every = [n for n in archive.namelist() if n.lower().endswith((".brp", ".brep"))]
    try:
        document = ElementTree.fromstring(archive.read("Document.xml"))
        view = ElementTree.fromstring(archive.read("GuiDocument.xml"))
    except (KeyError, ElementTree.ParseError):
        return every
    visible = set()
    for provider in view.iter("ViewProvider"):
        for item in provider.iter("Property"):
            flag = item.find("Bool")
            shown = flag is not None and flag.get("value") == "true"
            if item.get("name") == "Visibility" and shown:
                visible.add(provider.get("name"))
    shape_of: dict[str, str] = {}
    inside: set[str] = set()
    data = document.find("ObjectData")
    for item in data.iter("Object") if data is not None else ():
        for entry in item.iter("Property"):
            part = entry.find("Part")
            if entry.get("name") == "Shape" and part is not None and part.get("file"):
                shape_of[str(item.get("name"))] = str(part.get("file"))
            if entry.get("name") == "Group":
                inside.update(str(x.get("value")) for x in entry.iter("Link"))
    bodies = {n for n in shape_of if n in visible and n not in inside}
    names = bodies or {n for n in shape_of if n in visible}
    return [f for n, f in shape_of.items() if n in names and f in every] or every


_READERS = {
    ".step": _step,
    ".stp": _step,
    ".iges": _iges,
    ".igs": _iges,
    ".brep": _brep,
    ".brp": _brep,
    ".fcstd": _fcstd,
}
