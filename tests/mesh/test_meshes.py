"""Swept hexahedra: geometry that can be checked against closed forms."""

import re

import numpy as np
import pytest

from myograph.anatomy.body import muscle_body
from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.mesh.presets import RESOLUTIONS, preset_mesh, resolution
from myograph.mesh.quality import check_mesh, scaled_jacobians
from myograph.mesh.section import o_grid
from myograph.mesh.sweep import Resolution, Tube, sweep
from myograph.mesh.tissue import tendon_share

LATERAL = np.array([0.0, 1.0, 0.0])


def _straight_tube(stations, radius=10.0, length=100.0):
    centres = np.outer(np.linspace(0, length, stations), [0.0, 0.0, 1.0])
    return Tube(centres, np.full(stations, np.pi * radius**2), np.ones(stations), LATERAL, length)


def _bent_tube(stations, bend, radius=10.0):
    angle = np.linspace(0, np.pi / 2, stations)
    centres = bend * np.stack([1 - np.cos(angle), 0 * angle, np.sin(angle)], axis=1)
    return Tube(centres, np.full(stations, np.pi * radius**2), np.ones(stations), LATERAL, bend * np.pi / 2)


@pytest.mark.parametrize(("core", "rings"), [(1, 0), (1, 1), (2, 1), (2, 2), (3, 2)])
def test_the_o_grid_has_as_many_nodes_as_counted_and_its_rim_is_the_circle(core, rings):
    section = o_grid(core, rings)
    assert len(section.nodes) == (2 * core + 1) ** 2 + 16 * core * rings
    assert len(section.quads) == core**2 + 4 * core * rings
    radius = np.linalg.norm(section.nodes[section.rim], axis=1)
    assert radius == pytest.approx(radius[0], rel=1e-12 if rings else 0.2)


@pytest.mark.parametrize("size", RESOLUTIONS.values(), ids=RESOLUTIONS.keys())
def test_a_straight_tube_has_the_volume_of_its_cylinder(size):
    mesh = sweep(_straight_tube(2 * size.along + 1), size)
    assert mesh.volume() == pytest.approx(np.pi * 100 * 100, rel=1e-12)


def test_the_volume_of_a_bent_tube_converges_to_pappus():
    exact = np.pi * 10**2 * 40 * np.pi / 2
    errors = []
    for along in (4, 8, 16):
        mesh = sweep(_bent_tube(2 * along + 1, 40.0), Resolution(1, 1, along))
        errors.append(abs(mesh.volume() / exact - 1))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-3
    assert orders.min() > 1.8


def test_the_skin_is_closed_and_its_normals_point_outwards():
    """Divergence theorem: the volume inside the skin is positive and near the cylinder's."""
    mesh = sweep(_straight_tube(41), Resolution(2, 2, 20))
    a, b, c, d = np.moveaxis(mesh.points[mesh.skin], 1, 0)
    normals, middles = np.cross(c - a, d - b) / 2, (a + b + c + d) / 4
    assert normals.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.einsum("qa,qa->", normals, middles) / 3 == pytest.approx(np.pi * 1e4, rel=0.03)
    edges = np.sort(np.concatenate([mesh.skin[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


@pytest.mark.parametrize(("preset", "nodes"), [("tiny", 150), ("quick", 1000), ("thesis", 4000)])
@pytest.mark.parametrize("name", MUSCLES)
def test_every_muscle_meshes_well_in_every_size(preset, nodes, name):
    mesh = preset_mesh(built_in_arm(), name, preset)
    if (name, preset) != ("anconeus", "thesis"):
        assert len(mesh.points) == pytest.approx(nodes, rel=0.03)
    assert scaled_jacobians(mesh).min() > 0.02


def test_a_small_muscle_has_no_cells_far_smaller_than_the_others():
    finest = {name: preset_mesh(built_in_arm(), name, "thesis") for name in MUSCLES}
    volumes = {name: mesh.volume() / len(mesh.cells) for name, mesh in finest.items()}
    assert min(volumes.values()) > 100
    assert len(finest["anconeus"].points) == len(preset_mesh(built_in_arm(), "anconeus", "quick").points)


@pytest.mark.parametrize("name", MUSCLES)
def test_the_volume_of_a_body_is_that_of_its_mesh(name):
    arm = built_in_arm()
    assert muscle_body(arm, name, 201).volume == pytest.approx(preset_mesh(arm, name, "thesis").volume(), rel=0.05)


def test_the_biceps_is_as_large_as_measured():
    mesh = preset_mesh(built_in_arm(), "biceps", "quick")
    assert mesh.volume() / 1000 == pytest.approx(320, rel=0.05)


def test_a_folded_mesh_is_refused_and_its_worst_element_named():
    size = Resolution(1, 1, 6)
    with pytest.raises(InputError, match=re.escape("mesh of knee: element") + r".*scaled Jacobian of -"):
        check_mesh(sweep(_bent_tube(13, 5.0, radius=10.0), size), "knee")


def test_a_mesh_with_holes_in_its_numbers_is_refused():
    tube = _straight_tube(5)
    tube.centres[2] = np.nan
    with pytest.raises(InputError, match="no finite position"):
        check_mesh(sweep(tube, Resolution(1, 0, 2)), "biceps")


def test_an_unknown_preset_is_refused_with_the_known_ones():
    with pytest.raises(InputError, match="expected one of tiny, quick, thesis"):
        resolution("huge")


def test_ends_are_tendon_and_the_middle_is_belly():
    arm = built_in_arm()
    mesh = preset_mesh(arm, "biceps", "quick")
    share = tendon_share(arm, "biceps", mesh)
    assert share.min() == 0
    assert share.max() == 1
    assert share[mesh.end_nodes("origin")] == pytest.approx(np.ones(25))
    assert share[np.abs(mesh.along - 0.5) < 0.05].max() == 0
