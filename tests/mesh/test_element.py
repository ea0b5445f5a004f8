"""Shape functions and rules of integration of both kinds of elements."""

from math import factorial

import numpy as np
import pytest

from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import SMALL, TET10

BOTH = pytest.mark.parametrize("element", [HEX27, TET10], ids=lambda element: element.kind)


@BOTH
def test_shape_functions_are_one_at_their_node_and_sum_to_one(element):
    assert element.values(element.nodes) == pytest.approx(np.eye(len(element.nodes)), abs=1e-14)
    places = np.random.default_rng(1).uniform(-1, 1, (5, 3))
    assert element.values(places).sum(axis=1) == pytest.approx(np.ones(5))


@BOTH
def test_their_gradients_are_their_differences(element):
    places, step = np.random.default_rng(1).uniform(-1, 1, (5, 3)), 1e-6
    for axis in range(3):
        moved = np.eye(3)[axis] * step
        difference = (element.values(places + moved) - element.values(places - moved)) / (2 * step)
        assert element.gradients(places)[..., axis] == pytest.approx(difference, abs=1e-8)


@BOTH
def test_the_map_of_the_local_nodes_is_the_identity(element):
    cells = np.arange(len(element.nodes))[None]
    assert element.determinants(element.nodes, cells, element.places) == pytest.approx(1.0)
    assert element.volumes(element.nodes, cells).sum() == pytest.approx(8.0 if element is HEX27 else 1 / 6)


@pytest.mark.parametrize("powers", [(0, 0, 0), (2, 1, 0), (1, 1, 1), (5, 0, 0), (2, 2, 1)])
def test_the_rule_of_the_tetrahedron_is_exact_to_degree_five(powers):
    """The integral of x^a y^b z^c is a! b! c! / (a + b + c + 3)!."""
    exact = np.prod([factorial(p) for p in powers]) / factorial(sum(powers) + 3)
    assert TET10.weights @ np.prod(TET10.places ** np.array(powers), axis=1) == pytest.approx(exact, rel=1e-13)


def test_eight_small_tetrahedra_fill_the_tetrahedron():
    """Positive volumes and no overlap: each place lies in exactly one of them."""
    small = TET10.nodes[np.array(SMALL)]
    sides = small[:, 1:] - small[:, :1]
    assert np.abs(np.linalg.det(sides)) == pytest.approx(1 / 8)
    places = np.random.default_rng(0).dirichlet(np.ones(4), 200)[:, 1:]
    shares = np.linalg.solve(np.swapaxes(sides, 1, 2)[:, None], (places - small[:, :1])[..., None])[..., 0]
    assert ((shares.min(axis=2) > 0) & (shares.sum(axis=2) < 1)).sum(axis=0).tolist() == [1] * 200


@BOTH
def test_facet_corners_and_quads_speak_of_the_same_facet(element):
    """The outlines of the facet's linear quadrilaterals, added up, are its own outline."""
    edges = [(quad[k], quad[(k + 1) % 4]) for quad in element.facet_quads for k in range(4)]
    open_edges = {(a, b) for a, b in edges if a != b and (b, a) not in edges}
    following = dict(open_edges)
    corner, seen = element.facet_corners[0], []
    for _ in open_edges:
        seen.append(corner)
        corner = following[corner]
    assert [node for node in seen if node in element.facet_corners] == list(element.facet_corners)
