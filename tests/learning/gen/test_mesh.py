"""The graph: nodes on a disturbed grid, edges of a Delaunay triangulation, normalised adjacency."""

from itertools import combinations

import numpy as np
import pytest
from scipy.spatial import Delaunay

from myograph.errors import InputError
from myograph.learning.gen.mesh import delaunay_edges, edges_of, grid_nodes, normalised_adjacency, triangulate

SIDES = np.array([0.3, 0.2, 1.0])


@pytest.mark.parametrize("per_axis", [2, 7])
@pytest.mark.parametrize("axes", [1, 2, 3])
def test_the_grid_fills_its_box_and_stays_inside(per_axis, axes):
    nodes = grid_nodes(per_axis, SIDES[:axes], seed=0)
    assert nodes.shape == (per_axis**axes, axes)
    assert (nodes >= 0).all()
    assert (nodes <= SIDES[:axes]).all()
    assert (np.ptp(nodes, axis=0) > 0.8 * SIDES[:axes]).all()


def test_grid_nodes_leave_their_places_by_a_fifth_of_the_spacing():
    per_axis = 21
    lines = [np.linspace(0, side, per_axis) for side in SIDES]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    inner = (slice(3, -3),) * 3  # where nothing is clamped
    moved = (grid_nodes(per_axis, SIDES, seed=0).reshape(grid.shape) - grid)[inner] * (per_axis - 1) / SIDES
    assert moved.std(axis=(0, 1, 2)) == pytest.approx([0.2] * 3, rel=0.05)


def test_a_tetrahedron_has_six_edges_and_a_triangle_three():
    tetrahedron = np.vstack([np.zeros(3), np.eye(3)])
    assert {tuple(edge) for edge in delaunay_edges(tetrahedron)} == set(combinations(range(4), 2))
    assert len(delaunay_edges(tetrahedron[:3, :2])) == 3


@pytest.mark.parametrize("per_axis", [2, 7])
def test_vertices_edges_faces_and_tetrahedra_obey_euler(per_axis):
    """A triangulated ball: V - E + F - T = 1."""
    nodes = grid_nodes(per_axis, SIDES, seed=3)
    tetrahedra = Delaunay(nodes).simplices
    faces = {tuple(sorted(face)) for t in tetrahedra for face in combinations(t, 3)}
    assert len(nodes) - len(delaunay_edges(nodes)) + len(faces) - len(tetrahedra) == 1


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("per_axis", [2, 7])
def test_no_node_is_isolated(per_axis, seed):
    nodes = grid_nodes(per_axis, SIDES, seed)
    neighbours = np.bincount(delaunay_edges(nodes).ravel(), minlength=len(nodes))
    assert neighbours.min() >= 3


def test_a_node_that_falls_together_with_another_is_joined_to_it():
    nodes = grid_nodes(2, SIDES, seed=0)
    edges = delaunay_edges(np.vstack([nodes, nodes[5]]))
    assert [5, 8] in edges.tolist()


def test_each_edge_stands_once_and_no_node_is_joined_to_itself():
    edges = delaunay_edges(grid_nodes(7, SIDES, seed=0))
    assert len(np.unique(edges, axis=0)) == len(edges)
    assert (edges[:, 0] < edges[:, 1]).all()


def test_nodes_in_one_plane_are_an_input_error():
    with pytest.raises(InputError, match="graph of 8 nodes: expected nodes that span a volume"):
        delaunay_edges(grid_nodes(2, SIDES, seed=0) * [1, 1, 0])


def test_roots_of_degrees_are_an_eigenvector_of_the_adjacency_with_eigenvalue_one():
    edges = delaunay_edges(grid_nodes(7, SIDES, seed=0))
    adjacency = normalised_adjacency(edges, 343)
    roots = np.sqrt(1 + np.bincount(edges.ravel(), minlength=343))
    np.testing.assert_allclose(adjacency @ roots, roots, rtol=1e-12)
    assert abs(adjacency - adjacency.T).max() == 0


def test_a_loop_over_triangles_leaves_half_of_the_edges_of_a_tetrahedron_out():
    tetrahedron = triangulate(np.vstack([np.zeros(3), np.eye(3)]))
    assert len(edges_of(tetrahedron, corners=3)) == 3


def test_a_loop_over_triangles_leaves_nodes_in_space_with_fewer_neighbours():
    triangulation = triangulate(grid_nodes(2, SIDES, seed=0))
    right, trap = (np.bincount(edges_of(triangulation, corners).ravel(), minlength=8) for corners in (None, 3))
    assert (trap <= right).all()
    assert trap.sum() < right.sum()
