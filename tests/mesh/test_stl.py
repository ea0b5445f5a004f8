"""STL files: what is read, and what is refused."""

import re
import struct

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.mesh.surface import read_surface, stl
from myograph.mesh.surface.stl import read_stl
from tests.mesh.shapes import box_triangles


def _corners():
    points, triangles = box_triangles((2.0, 3.0, 4.0))
    return points[triangles]


def _with_nan():
    corners = _corners()
    corners[2, 1, 0] = np.nan
    return corners


def _binary(corners, header=b"made by a test", count=None):
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), 0) for triangle in corners)
    return header.ljust(80, b"\0") + struct.pack("<I", len(corners) if count is None else count) + records


def _text(corners):
    facets = "".join(
        "facet normal 0 0 0\n outer loop\n"
        + "".join(f"  vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in triangle)
        + " endloop\nendfacet\n"
        for triangle in corners
    )
    return f"solid box of mine\n{facets}endsolid box of mine\n".encode()


@pytest.mark.parametrize(
    "data",
    [_binary(_corners()), _text(_corners()), _binary(_corners(), b"solid though binary"), _text(_corners()).upper()],
    ids=["binary", "text", "binary that begins as text does", "capitals"],
)
def test_all_kinds_of_files_give_the_same_triangles(tmp_path, data):
    path = tmp_path / "box.stl"
    path.write_bytes(data)
    assert read_stl(path) == pytest.approx(_corners(), abs=1e-6)
    surface = read_surface(path)
    assert len(surface.points) == 8
    assert surface.volume == pytest.approx(24.0, rel=1e-6)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (_binary(_corners(), count=4_000_000_000), "header says 4000000000 triangles, the rest holds 12"),
        (_binary(_corners())[:-7], "the rest holds 11.86"),
        (_binary(_corners())[:50], "fewer than its header has"),
        (_binary(_corners()[:0]), "found none in it"),
        (_binary(_with_nan()), "triangle 2 has a corner that is no number"),
        (_text(_corners())[:-30], "expected 3 vertices in each of its 11 closed facets and 'endsolid'"),
        (_text(_corners()).replace(b"  vertex 2 3 4\n", b"", 1), "got 35 vertices"),
        (_text(_corners()).replace(b"vertex 2 3 4", b"vertex 2 x 4", 1), "three numbers after 'vertex', got '2 x 4'"),
    ],
)
def test_a_damaged_file_is_refused_with_what_is_wrong(tmp_path, data, message):
    path = tmp_path / "box.stl"
    path.write_bytes(data)
    with pytest.raises(InputError, match=re.escape(message)) as caught:
        read_stl(path)
    assert str(path) in str(caught.value)


def test_a_missing_or_huge_file_is_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match=r"nowhere\.stl: cannot be read"):
        read_stl(tmp_path / "nowhere.stl")
    path = tmp_path / "box.stl"
    path.write_bytes(_binary(_corners()))
    monkeypatch.setattr(stl, "LARGEST_FILE", 600)
    with pytest.raises(InputError, match="expected at most 600 bytes, got 684"):
        read_stl(path)


def test_mistakes_of_the_surface_name_its_file(tmp_path):
    path = tmp_path / "open.stl"
    path.write_bytes(_binary(_corners()[:-1]))
    with pytest.raises(InputError, match=r"open\.stl: open: 3 edges"):
        read_surface(path)
