"""Nodes on a line: neighbours are joined, places lie between them."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.gen.line import line_through
from myograph.learning.gen.mesh import delaunay_edges, triangulate

NODES = np.array([[0.5], [0.0], [1.0], [0.25]])


def test_neighbours_are_joined_in_whatever_order_the_nodes_come():
    assert delaunay_edges(NODES).tolist() == [[0, 2], [0, 3], [1, 3]]


def test_a_place_lies_in_the_piece_between_its_neighbours():
    line = line_through(NODES)
    assert line.simplices.tolist() == [[1, 3], [3, 0], [0, 2]]
    places = np.array([[-0.1, 0.0, 0.1, 0.25, 0.3], [0.5, 0.9, 1.0, 1.1, 2.0]])[..., None]
    assert line.find_simplex(places).tolist() == [[-1, 0, 0, 1, 1], [2, 2, 2, -1, -1]]


def test_nodes_that_fall_together_are_joined_to_one_another():
    nodes = np.vstack([NODES, [[1.0], [0.0]]])
    line = line_through(nodes)
    assert line.coplanar.tolist() == [[4, 2, 2], [5, 0, 1]]
    assert {(2, 4), (1, 5)} < set(map(tuple, delaunay_edges(nodes).tolist()))


def test_nodes_that_all_fall_together_are_an_input_error():
    with pytest.raises(
        InputError, match="graph of 3 nodes: expected nodes that span a volume: all nodes fall together"
    ):
        triangulate(np.ones((3, 1)))
