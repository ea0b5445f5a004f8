"""STL: read again it is the same closed surface."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.export.stl import HEADER_BYTES, write_stl
from myograph.mesh.surface.stl import read_stl
from tests.export.conftest import box


def volume(corners):
    a, b, c = np.moveaxis(corners, 1, 0)
    return np.einsum("tx,tx->", a, np.cross(b, c)) / 6


def test_bodies_are_read_again_with_their_volume_and_normals_outwards(tmp_path):
    body = box()
    count = write_stl(tmp_path / "two.stl", {"a": (body.reference, body.skin), "b": (body.reference + 50, body.skin)})
    corners = read_stl(tmp_path / "two.stl")
    assert len(corners) == count == 4 * len(body.skin)
    assert volume(corners) == pytest.approx(4000)
    data = np.frombuffer((tmp_path / "two.stl").read_bytes()[HEADER_BYTES + 4 :], np.uint8).reshape(count, 50)
    normals = data[:, :12].copy().view("<f4")
    outwards = corners[: count // 2].mean(axis=1) - body.reference.mean(axis=0)
    assert (np.einsum("tx,tx->t", normals[: count // 2], outwards) > 0).all()


def test_a_repeated_corner_is_one_triangle(tmp_path):
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    assert write_stl(tmp_path / "one.stl", {"a": (points, np.array([[0, 1, 2, 2]]))}) == 1


def test_no_surface_and_other_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="expected bodies with a surface, got none of a"):
        write_stl(tmp_path / "x.stl", {"a": (np.zeros((3, 3)), np.zeros((0, 4), dtype=int))})
    (tmp_path / "x.stl").write_text("my thesis")
    with pytest.raises(InputError, match="found something else"):
        write_stl(tmp_path / "x.stl", {"a": (np.eye(3), np.array([[0, 1, 2, 2]]))})
