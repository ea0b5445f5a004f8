"""Elements in VTK's order, and the skin of a body."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import TET10
from myograph.mesh.vtk import KINDS, cell_kind, from_vtk, skin_of, to_vtk

CUBE = HEX27.nodes / 2 + 0.5
NODES = {4: TET10.nodes[:4], 10: TET10.nodes, 27: CUBE, **{n: CUBE[list(KINDS[27].order[:n])] for n in (8, 20)}}
VOLUME = {4: 1 / 6, 10: 1 / 6, 8: 1, 20: 1, 27: 1}
AREA = {n: 6 if VOLUME[n] == 1 else 1.5 + np.sqrt(3) / 2 for n in VOLUME}


def measures(points, quads):
    """Area, and volume by Gauss's theorem, of the triangles that quadrilaterals are made of."""
    halves = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    a, b, c = np.moveaxis(points[halves], 1, 0)
    normals = np.cross(b - a, c - a) / 2
    return np.linalg.norm(normals, axis=1).sum(), np.einsum("fx,fx->", a, normals) / 3


@pytest.mark.parametrize("nodes", KINDS)
def test_the_skin_of_one_element_is_closed_and_looks_outwards(nodes):
    points, cells = NODES[nodes] + 5, np.arange(nodes)[None]
    assert measures(points, skin_of(points, cells)) == pytest.approx((AREA[nodes], VOLUME[nodes]))


def test_two_elements_have_no_skin_between_them():
    points = np.vstack([NODES[8], NODES[8] + [1, 0, 0]])
    cells = np.array([[0, 1, 2, 3, 4, 5, 6, 7], [1, 9, 10, 2, 5, 13, 14, 6]])
    assert measures(points, skin_of(points, cells)) == pytest.approx((10, 2))


def test_elements_that_are_inside_out_have_an_outward_skin_too():
    points = NODES[8] * [1, 1, -1]
    assert measures(points, skin_of(points, np.arange(8)[None]))[1] == pytest.approx(1)


@pytest.mark.parametrize("nodes", KINDS)
def test_to_vtk_and_back_changes_nothing(nodes):
    cells = np.random.default_rng(0).permutation(3 * nodes).reshape(3, nodes)
    np.testing.assert_array_equal(from_vtk(to_vtk(cells)), cells)


def test_elements_of_another_number_of_nodes_are_refused():
    with pytest.raises(InputError, match="expected 4, 8, 10, 20 or 27 nodes each, got 6"):
        cell_kind(6)
