"""Fields between the nodes, and pieces of tissue of one mesh in another."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.mesh.between import between
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.presets import preset_mesh
from myograph.mesh.tetrahedra import TET10


def bent(element):
    """Nodes and cells of one curved element."""
    x, y, z = element.nodes.T
    nodes = np.stack([3 * x + 0.2 * y**2, 2 * y, 4 * z + 0.3 * x * (y + z)], axis=1)
    return nodes, np.arange(len(x))[None]


@pytest.mark.parametrize("element", [HEX27, TET10])
def test_between_nodes_a_linear_field_is_exact_and_at_nodes_any_field(element):
    nodes, cells = bent(element)
    inner = np.random.default_rng(0).dirichlet(np.ones(4), size=6) @ element.nodes[list(element.corners[:4])]
    points = element.values(inner * 0.9 + 0.1 * element.nodes.mean(axis=0)) @ nodes
    assert np.allclose(between(nodes, cells, points).carry(nodes[None])[0], points, atol=1e-8)
    values = np.random.default_rng(1).normal(size=(2, len(nodes)))
    assert np.allclose(between(nodes, cells, nodes).carry(values), values, atol=1e-6)


@pytest.mark.parametrize("preset", ["tiny", "quick"])
def test_tissue_of_one_mesh_is_found_in_another(preset):
    finer = preset_mesh(built_in_arm(), "biceps", "quick")
    mesh = preset_mesh(built_in_arm(), "biceps", preset)
    inner = finer.points[np.setdiff1d(np.arange(len(finer.points)), finer.skin)[::60]]
    weights = between(mesh.points, mesh.cells, inner).matrix(len(mesh.points))
    np.testing.assert_allclose(weights.sum(axis=1), 1, atol=1e-9)
    np.testing.assert_allclose(weights @ mesh.points, inner, atol=1e-6)
    affine = 1.1 * np.array([[1, 0.2, 0], [0, 1, 0.3], [0, 0, 1]])
    np.testing.assert_allclose(weights @ (mesh.points @ affine + 5), inner @ affine + 5, atol=1e-6)


def test_a_node_is_itself():
    mesh = preset_mesh(built_in_arm(), "biceps", "tiny")
    nodes = np.array([0, 17, len(mesh.points) - 1])
    weights = between(mesh.points, mesh.cells, mesh.points[nodes]).matrix(len(mesh.points))
    np.testing.assert_allclose(weights, np.eye(len(mesh.points))[nodes], atol=1e-6)


def test_places_outside_and_unknown_elements_are_refused():
    nodes, cells = bent(HEX27)
    with pytest.raises(InputError, match=r"expected places in the body, got \[50.0, 0.0, 0.0\] mm outside of it"):
        between(nodes, cells, np.array([[50.0, 0, 0]]))
    for unknown in (cells[:, :8], np.zeros((0, 8), dtype=np.int64)):
        with pytest.raises(InputError, match="expected 27 or 10 nodes each"):
            between(nodes, unknown, nodes)
