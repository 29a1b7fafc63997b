# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files of every variant give the same solid; broken ones give typed errors."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import shapes

from freecad_tetra.errors import (
    InvalidSolid,
    KernelMissing,
    TetraError,
    UnreadableFile,
    UnsupportedFormat,
)
from freecad_tetra.io import read_mesh

SHAPE = shapes.l_prism()
Maker = Callable[[np.ndarray, np.ndarray], bytes]


def stl_ascii(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["solid part with words"]
    for t in f:
        rows.append(" facet normal 0 0 0\n  outer loop")
        rows += ["   vertex {:.9e} {:.9e} {:.9e}".format(*v[i]) for i in t]
        rows.append("  endloop\n endfacet")
    return ("\n".join([*rows, "endsolid part with words"]) + "\n").encode()


def stl_binary(v: np.ndarray, f: np.ndarray, head: bytes = b"binary") -> bytes:
    out = head.ljust(80, b" ") + struct.pack("<I", len(f))
    for t in f:
        out += struct.pack("<12fH", 0, 0, 0, *v[t].reshape(-1), 7)
    return out


def stl_binary_solid(v: np.ndarray, f: np.ndarray) -> bytes:
    return stl_binary(v, f, b"solid by a careless program")


def obj_plain(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["# comment", "mtllib x.mtl", "o part"]
    rows += ["v {:.17g} {:.17g} {:.17g}".format(*p) for p in v]
    rows += ["f {} {} {}".format(*(t + 1)) for t in f]
    return ("\n".join(rows) + "\n").encode()


def obj_textured(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["v {:.17g} {:.17g} {:.17g} 1.0".format(*p) for p in v]
    rows += ["vt 0 0", "vn 0 0 1", "s off"]
    rows += ["f {}/1/1 {}//1 {}/1 # end".format(*(t + 1)) for t in f]
    return "\r\n".join(rows).encode() + b"\r\n"


def obj_negative(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["v {:.17g} {:.17g} {:.17g}".format(*p) for p in v]
    rows += ["f {} {} \\\n {}".format(*(t - len(v))) for t in f]
    return ("\n".join(rows) + "\n").encode()


def off_plain(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["OFF", f"{len(v)} {len(f)} 0"]
    rows += ["{:.17g} {:.17g} {:.17g}".format(*p) for p in v]
    rows += ["3 {} {} {}".format(*t) for t in f]
    return ("\n".join(rows) + "\n").encode()


def off_coloured(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["# made up", f"COFF {len(v)} {len(f)}"]
    rows += ["{:.17g} {:.17g} {:.17g} 255 0 0 255".format(*p) for p in v]
    rows += ["3 {} {} {} 0.5 0.5 0.5 # grey".format(*t) for t in f]
    return ("\n\n".join(rows) + "\n").encode()


def ply_ascii(v: np.ndarray, f: np.ndarray) -> bytes:
    rows = ["ply", "format ascii 1.0", "comment x", f"element vertex {len(v)}"]
    rows += ["property double x", "property double y", "property double z"]
    rows += [f"element face {len(f)}", "property list uchar int vertex_indices", "end_header"]
    rows += ["{:.17g} {:.17g} {:.17g}".format(*p) for p in v]
    rows += ["3 {} {} {}".format(*t) for t in f]
    return ("\n".join(rows) + "\n").encode()


def ply_binary(v: np.ndarray, f: np.ndarray, order: str = "<") -> bytes:
    name = "little" if order == "<" else "big"
    head = f"ply\nformat binary_{name}_endian 1.0\nelement vertex {len(v)}\n"
    head += "property uchar red\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {len(f)}\nproperty uchar flags\n"
    head += "property list uchar uint vertex_index\nend_header\n"
    out = head.encode()
    for p in v:
        out += struct.pack(order + "B3d", 9, *p)
    for t in f:
        out += struct.pack(order + "BB3I", 1, 3, *t)
    return out


def ply_big(v: np.ndarray, f: np.ndarray) -> bytes:
    return ply_binary(v, f, ">")


FORMATS: dict[str, tuple[str, Maker]] = {
    "stl_ascii": (".stl", stl_ascii),
    "stl_binary": (".stl", stl_binary),
    "stl_binary_solid": (".stl", stl_binary_solid),
    "obj_plain": (".obj", obj_plain),
    "obj_textured": (".obj", obj_textured),
    "obj_negative": (".obj", obj_negative),
    "off_plain": (".off", off_plain),
    "off_coloured": (".OFF", off_coloured),
    "ply_ascii": (".ply", ply_ascii),
    "ply_binary": (".ply", ply_binary),
    "ply_big": (".PLY", ply_big),
}


@pytest.fixture(params=sorted(FORMATS))
def variant(request: pytest.FixtureRequest) -> tuple[str, Maker]:
    return FORMATS[request.param]


def written(folder: Path, variant: tuple[str, Maker], v: np.ndarray, f: np.ndarray) -> Path:
    path = folder / f"part{variant[0]}"
    path.write_bytes(variant[1](v, f))
    return path


def test_every_variant_gives_the_same_triangles(tmp_path: Path, variant: tuple[str, Maker]) -> None:
    solid = read_mesh(written(tmp_path, variant, SHAPE.vertices, SHAPE.triangles))
    assert np.array_equal(solid.vertices[solid.triangles], SHAPE.vertices[SHAPE.triangles]), (
        "coordinates, order and orientation are kept"
    )
    assert len(np.unique(solid.triangles)) == len(SHAPE.vertices)
    assert solid.face_ids.tolist() == list(range(len(SHAPE.triangles)))
    assert solid.name == "part"


def test_17_digits_come_back_bit_for_bit(tmp_path: Path) -> None:
    v = SHAPE.vertices @ shapes.rotation(5).T
    for name in ("obj_plain", "off_plain", "ply_ascii", "ply_binary"):
        solid = read_mesh(written(tmp_path, FORMATS[name], v, SHAPE.triangles))
        assert np.array_equal(solid.vertices, v)


def test_soup_of_an_indexed_format_is_welded(tmp_path: Path) -> None:
    soup = SHAPE.vertices[SHAPE.triangles].reshape(-1, 3)
    rows = np.arange(len(soup)).reshape(-1, 3)
    solid = read_mesh(written(tmp_path, FORMATS["obj_plain"], soup, rows))
    assert len(np.unique(solid.triangles)) == len(SHAPE.vertices)
    assert len(solid.vertices) == len(soup), "vertices keep their numbers"


def test_minus_zero_is_zero(tmp_path: Path) -> None:
    v = SHAPE.vertices.copy()
    soup = v[SHAPE.triangles].reshape(-1, 3)
    soup[::2][soup[::2] == 0] = -0.0
    rows = np.arange(len(soup)).reshape(-1, 3)
    for name in ("stl_binary", "obj_plain"):
        solid = read_mesh(written(tmp_path, FORMATS[name], soup, rows))
        assert len(np.unique(solid.triangles)) == len(SHAPE.vertices)


def test_nearly_equal_vertices_stay_apart(tmp_path: Path) -> None:
    soup = SHAPE.vertices[SHAPE.triangles].reshape(-1, 3).astype(float)
    soup[0, 0] = np.nextafter(soup[0, 0], 9)
    rows = np.arange(len(soup)).reshape(-1, 3)
    solid = read_mesh(written(tmp_path, FORMATS["off_plain"], soup, rows))
    assert len(np.unique(solid.triangles)) == len(SHAPE.vertices) + 1


def test_convex_polygons_become_fans(tmp_path: Path) -> None:
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    v = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    text = f"OFF\n8 6 0\n{''.join(f'{x} {y} {z}' + chr(10) for x, y, z in v)}"
    text += "".join("4 " + " ".join(map(str, q)) + "\n" for q in quads)
    path = tmp_path / "cube.off"
    path.write_text(text)
    solid = read_mesh(path)
    assert solid.volume() == 1.0 and len(solid.triangles) == 12
    assert solid.face_ids.tolist() == [i // 2 for i in range(12)]


def test_fan_avoids_flat_triangles(tmp_path: Path) -> None:
    path = tmp_path / "bar.off"
    path.write_text("OFF\n5 1 0\n0 0 0\n1 0 0\n2 0 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n")
    solid = read_mesh(path)
    corners = solid.vertices[solid.triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert (areas > 0).all() and areas.sum() == 4.0


def test_concave_polygon_goes_to_the_triangulator(tmp_path: Path) -> None:
    path = tmp_path / "arrow.off"
    path.write_text("OFF\n4 1 0\n0 0 5\n4 0 5\n1 1 5\n0 4 5\n4 0 1 2 3\n")
    with pytest.raises(KernelMissing):
        read_mesh(path)
    asked = []

    def split(points: np.ndarray, loop: np.ndarray) -> np.ndarray:
        asked.append(points.tolist())
        return np.array([[0, 1, 2], [0, 2, 3]], np.int32)

    assert len(read_mesh(path, split).triangles) == 2
    assert asked == [[[0, 0], [4, 0], [1, 1], [0, 4]]]


def test_zero_and_missing_and_empty_files(tmp_path: Path) -> None:
    for suffix in (".stl", ".obj", ".off", ".ply"):
        with pytest.raises(UnreadableFile):
            read_mesh(tmp_path / f"none{suffix}")
        for content in (b"", b"  \n \n"):
            path = tmp_path / f"empty{suffix}"
            path.write_bytes(content)
            with pytest.raises(UnreadableFile, match="empty"):
                read_mesh(path)
        with pytest.raises(UnreadableFile):
            (tmp_path / f"folder{suffix}").mkdir()
            read_mesh(tmp_path / f"folder{suffix}")
    with pytest.raises(UnsupportedFormat):
        read_mesh(tmp_path / "part.xyz")


def test_files_without_triangles_are_invalid(tmp_path: Path) -> None:
    nothing = np.zeros((0, 3), int)
    for name in ("stl_ascii", "stl_binary", "obj_plain", "off_plain", "ply_ascii", "ply_binary"):
        with pytest.raises(InvalidSolid) as caught:
            read_mesh(written(tmp_path, FORMATS[name], SHAPE.vertices, nothing))
        assert caught.value.defects[0].kind == "empty"


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_nonfinite_coordinates_are_invalid(
    tmp_path: Path, variant: tuple[str, Maker], value: float
) -> None:
    v = SHAPE.vertices.copy()
    v[3, 1] = value
    with pytest.raises(InvalidSolid) as caught:
        read_mesh(written(tmp_path, variant, v, SHAPE.triangles))
    assert caught.value.defects[0].kind == "nonfinite_coordinate"
    assert len(caught.value.defects[0].vertices) >= 1


def test_ids_out_of_range_are_unreadable(tmp_path: Path) -> None:
    rows = SHAPE.triangles.copy()
    rows[2, 1] = 999
    for name in ("obj_plain", "off_plain", "off_coloured", "ply_ascii", "ply_binary"):
        with pytest.raises(UnreadableFile, match="does not exist"):
            read_mesh(written(tmp_path, FORMATS[name], SHAPE.vertices, rows))


def test_counts_beyond_the_file_need_no_memory(tmp_path: Path) -> None:
    path = tmp_path / "huge.off"
    path.write_text("OFF\n2000000000 2000000000 0\n0 0 0\n")
    with pytest.raises(UnreadableFile):
        read_mesh(path)
    path = tmp_path / "huge.ply"
    path.write_bytes(
        ply_binary(SHAPE.vertices, SHAPE.triangles).replace(b"face 28", b"face 2000000000")
    )
    with pytest.raises(UnreadableFile):
        read_mesh(path)


def test_every_truncation_is_a_typed_error(tmp_path: Path, variant: tuple[str, Maker]) -> None:
    whole = variant[1](SHAPE.vertices, SHAPE.triangles)
    path = tmp_path / f"cut{variant[0]}"
    for length in range(0, len(whole), max(1, len(whole) // 150)):
        path.write_bytes(whole[:length])
        try:
            solid = read_mesh(path)
        except TetraError:
            continue
        # A text format without an end mark may be cut between two faces, or within the last
        # number: validation sees the hole, or only the end of the last line is gone.
        assert variant[1] in (obj_plain, obj_textured, obj_negative) or len(whole) - length < 20
        assert len(solid.triangles) <= len(SHAPE.triangles)


def test_flipped_bytes_are_read_or_typed(tmp_path: Path, variant: tuple[str, Maker]) -> None:
    whole = variant[1](SHAPE.vertices, SHAPE.triangles)
    random = np.random.default_rng(11)
    path = tmp_path / f"flip{variant[0]}"
    for _ in range(150):
        data = bytearray(whole)
        for place in random.integers(0, len(data), random.integers(1, 6)):
            data[place] = random.integers(0, 256)
        path.write_bytes(bytes(data))
        try:
            read_mesh(path)
        except TetraError:
            continue


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".off", ".ply"])
def test_garbage_is_unreadable(tmp_path: Path, suffix: str) -> None:
    random = np.random.default_rng(3)
    heads = {".stl": b"solid ", ".obj": b"v ", ".off": b"OFF\n", ".ply": b"ply\n"}
    for size in (1, 10, 83, 84, 85, 200, 5000):
        for head in (b"", heads[suffix]):
            path = tmp_path / f"garbage{suffix}"
            path.write_bytes(head + random.integers(0, 256, size, dtype=np.uint8).tobytes())
            with pytest.raises(TetraError):
                read_mesh(path)
