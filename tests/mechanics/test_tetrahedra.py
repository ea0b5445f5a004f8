"""Tetrahedra from closed surfaces: the body they fill, and their spaces."""

import ngsolve as ngs
import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.mechanics.fibres import fibre_direction
from myograph.mechanics.layout import LAYOUTS
from myograph.mechanics.problem import MuscleProblem
from myograph.mechanics.space import nodal_space
from myograph.mechanics.tetrahedra import filled, surface_mesh
from myograph.mesh.muscle_mesh import FACETS
from myograph.mesh.quality import mean_ratios, scaled_jacobians
from myograph.mesh.surface import Attachment, Attachments
from tests.mechanics.conftest import recovered
from tests.mesh.shapes import box, spindle, spindle_mesh

ENDS = Attachments((Attachment((0.0, 0.0, 0.0), 6.3),), (Attachment((0.0, 0.0, 100.0), 6.3),))


@pytest.fixture(scope="module")
def surface():
    return spindle()


@pytest.fixture(scope="module")
def mesh(surface):
    return surface_mesh(surface, ENDS, 12.0, "spindle")


@pytest.fixture(scope="module")
def space(mesh):
    return nodal_space(mesh)


def test_the_mesh_has_the_volume_of_its_surface_and_good_elements(mesh, surface):
    assert mesh.volume() == pytest.approx(surface.volume, rel=0.01)
    assert scaled_jacobians(mesh).min() > 0.04
    assert mean_ratios(mesh).min() > 0.1


def test_smaller_elements_lose_less_volume(mesh, surface):
    fine = surface_mesh(surface, ENDS, 7.0, "spindle")
    assert abs(fine.volume() - surface.volume) < 0.6 * abs(mesh.volume() - surface.volume)
    assert len(fine.points) > 1.5 * len(mesh.points)


def test_skin_and_facets_close_the_body(mesh):
    """Divergence theorem over the linear quadrilaterals; every edge of the facets' corners belongs to two."""
    a, b, c, d = np.moveaxis(mesh.points[mesh.skin], 1, 0)
    normals, middles = np.cross(c - a, d - b) / 2, (a + b + c) / 3
    assert normals.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.einsum("qa,qa->", normals, middles) / 3 == pytest.approx(mesh.volume(), rel=0.03)
    corners = np.vstack([mesh.facets[name] for name in FACETS])[:, :3]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


def test_the_coordinate_and_the_sections_are_those_of_the_swept_spindle(mesh):
    """But for the curvature of the potential's level surfaces where the section grows."""
    swept = spindle_mesh()
    assert mesh.length == pytest.approx(100.0, rel=0.005)
    assert mesh.along == pytest.approx(mesh.points[:, 2] / 100, abs=0.025)
    wrong = np.abs(mesh.area / np.interp(mesh.along, swept.along, swept.area) - 1)
    assert np.median(wrong) < 0.03
    assert wrong.max() < 0.12
    for end, height in (("origin", 0.0), ("insertion", 100.0)):
        assert mesh.points[mesh.end_nodes(end)][:, 2] == pytest.approx(height, abs=1e-9)
        assert mesh.end_centre(end) == pytest.approx([0.0, 0.0, height], abs=0.2)


def test_nodal_values_lead_to_unknowns_and_back(mesh, space):
    values = np.random.default_rng(0).normal(size=len(mesh.points))
    assert space.to_nodes @ (space.to_unknowns @ values) == pytest.approx(values, abs=1e-12)


def test_the_curved_mesh_has_its_nodes_where_ours_are_and_the_same_volume(mesh, space):
    rule = ngs.IntegrationRule(LAYOUTS["tet10"].nodes.tolist(), [1.0] * 10)
    coordinates = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z))
    places = coordinates(space.mesh.MapToAllElements(rule, ngs.VOL)).reshape(-1, 10, 3)
    assert places == pytest.approx(mesh.points[mesh.cells], abs=1e-10)
    assert ngs.Integrate(1.0, space.mesh, order=6) == pytest.approx(mesh.volume(), rel=1e-10)


def test_linear_fields_are_recovered_exactly_at_the_nodes_of_straight_elements():
    surface = box((20.0, 20.0, 60.0), (4, 4, 10))
    ends = Attachments((Attachment((10.0, 10.0, 0.0), 30.0),), (Attachment((10.0, 10.0, 60.0), 30.0),))
    bar = surface_mesh(surface, ends, 15.0, "bar")
    space = nodal_space(bar)
    straight = ~np.isin(np.arange(len(bar.points)), bar.cells[scaled_jacobians(bar) < 1 - 1e-9])
    found = recovered(space, 2 * ngs.z - ngs.x)[:, 0]
    assert straight.mean() > 0.5
    assert found[straight] == pytest.approx((2 * bar.points[:, 2] - bar.points[:, 0])[straight], abs=1e-8)
    assert bar.volume() == pytest.approx(24000.0, rel=0.01)


def test_fibres_run_from_end_to_end(space):
    fibre = recovered(space, fibre_direction(space))
    assert np.abs(fibre[:, 2]).min() > 0.75
    assert recovered(space, ngs.Norm(fibre_direction(space))) == pytest.approx(1.0, abs=1e-12)


def test_residual_and_tangent_are_derivatives_on_tetrahedra_too(mesh):
    problem = MuscleProblem(built_in_arm(), "biceps", mesh)
    problem.controls.activation.Set(0.5)
    problem.controls.ramp.Set(1.0)
    rng, step = np.random.default_rng(5), 1e-5
    direction = 0.01 * rng.normal(size=problem.vector_size)
    direction[3 * problem.space.scalar.ndof :] *= 0.01
    place = 0.1 * direction
    low, high = (problem.energy(place + s * step * direction) for s in (-1, 1))
    assert problem.residual(place) @ direction == pytest.approx((high - low) / (2 * step), rel=1e-4)
    low, high = (problem.residual(place + s * step * direction) for s in (-1, 1))
    product, difference = problem.tangent(place).times(direction), (high - low) / (2 * step)
    assert np.linalg.norm(product - difference) < 1e-4 * np.linalg.norm(difference)


@pytest.mark.parametrize(("size", "message"), [(0.0, "size above 0 mm, got 0"), (float("nan"), "above 0 mm, got nan")])
def test_a_size_that_is_none_is_refused(surface, size, message):
    with pytest.raises(InputError, match=message):
        surface_mesh(surface, ENDS, size, "spindle")


def test_elements_that_lose_too_much_volume_are_refused(surface, monkeypatch):
    monkeypatch.setattr("myograph.mechanics.tetrahedra.LARGEST_LOSS", 1e-5)
    with pytest.raises(
        InputError, match=r"spindle: elements of 15 mm change the volume from 5\d\.\d+ to .*smaller ones"
    ):
        surface_mesh(surface, ENDS, 15.0, "spindle")


def test_a_surface_that_netgen_cannot_fill_is_refused(capfd):
    """Two boxes, one through the other; its own words go to the terminal."""
    one, other = box((4.0, 4.0, 4.0)), box((2.0, 2.0, 12.0))
    points = np.vstack([one.points, other.points + np.array([1.0, 1.0, -4.0])])
    with pytest.raises(InputError, match="mesh of star: Netgen cannot fill the surface"):
        filled(points, np.vstack([one.triangles, other.triangles + len(one.points)]), 4.0, "star")
    capfd.readouterr()
