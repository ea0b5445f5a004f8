"""Our nodes and NGSolve's unknowns are two bases of one space."""

import ngsolve as ngs
import numpy as np
import pytest

from myograph.mechanics.space import nodal_space
from myograph.mesh.hexahedra import lattice
from myograph.mesh.sweep import Resolution, Tube, sweep
from tests.mechanics.conftest import recovered


def test_nodal_values_lead_to_unknowns_and_back(biceps):
    values = np.random.default_rng(0).normal(size=len(biceps.mesh.points))
    space = biceps.space
    assert space.to_nodes @ (space.to_unknowns @ values) == pytest.approx(values, abs=1e-12)


def test_the_curved_mesh_has_its_nodes_where_ours_are(biceps):
    mesh = biceps.mesh
    rule = ngs.IntegrationRule(lattice((0.0, 0.5, 1.0)).tolist(), [1.0] * 27)
    coordinates = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z))
    places = coordinates(biceps.space.mesh.MapToAllElements(rule, ngs.VOL)).reshape(-1, 27, 3)
    assert places == pytest.approx(mesh.points[mesh.cells], abs=1e-10)


def test_coordinates_are_recovered_exactly_at_the_nodes_of_straight_elements():
    size = Resolution(2, 0, 5)
    centres = np.outer(np.linspace(0, 50, 11), [0.0, 0.0, 1.0])
    tube = Tube(centres, np.full(11, 100.0), np.ones(11), np.array([0.0, 1.0, 0.0]), 50.0)
    mesh = sweep(tube, size)
    height = recovered(nodal_space(mesh), 2 * ngs.z - 1)
    assert height[:, 0] == pytest.approx(2 * mesh.points[:, 2] - 1, abs=1e-10)


def test_both_sides_agree_on_the_volume(biceps):
    mesh = biceps.mesh
    ours = mesh.volume()
    assert ngs.Integrate(1.0, biceps.space.mesh, order=8) == pytest.approx(ours, rel=1e-10)


def test_fibres_are_unit_vectors_along_the_muscle(biceps):
    fibre, mesh = recovered(biceps.space, biceps.site.fibre), biceps.mesh
    assert recovered(biceps.space, ngs.Norm(biceps.site.fibre)) == pytest.approx(1.0, abs=1e-12)
    centres = np.array([mesh.points[mesh.along == place].mean(axis=0) for place in np.unique(mesh.along)])
    tangent = np.gradient(centres, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    along = (fibre.reshape(len(centres), -1, 3).mean(axis=1) * tangent).sum(axis=1)
    assert along.min() > 0.95
