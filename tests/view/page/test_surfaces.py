"""What the page draws: refined surfaces are exact at nodes, thinned ones keep nodes where they are."""

from collections import Counter

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.mesh.presets import preset_mesh
from myograph.view.page.smoothing import refine, triangles_of
from myograph.view.page.surface import page_surface
from myograph.view.page.thinning import thin
from myograph.view.surface import capsule


def tube(around=12, along=9, radius=10.0):
    """A round bar with open ends: nodes and outward quadrilaterals."""
    turn, height = np.linspace(0, 2 * np.pi, around, endpoint=False), np.linspace(0, 60, along)
    points = np.array([[radius * np.cos(t), radius * np.sin(t), z] for z in height for t in turn])
    node = np.arange(around * along).reshape(along, around)
    following = np.roll(node, -1, axis=1)
    return points, np.stack([node[:-1], following[:-1], following[1:], node[1:]], axis=-1).reshape(-1, 4)


def all_vertices(points, refined):
    return np.concatenate([points, np.einsum("vp,vpc->vc", refined.weights, points[refined.parents])])


def edges_of(triangles):
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return Counter(map(tuple, pairs.tolist()))


def volume(points, triangles):
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.einsum("ti,ti->", a, np.cross(b, c)) / 6


def test_new_vertices_are_sums_of_nodes_with_weights_of_one():
    points, quads = tube()
    refined = refine(points, quads)
    np.testing.assert_allclose(refined.weights.sum(axis=1), 1, atol=1e-12)
    assert len(refined.triangles) == 8 * len(quads)


def test_a_linear_field_stays_linear_between_nodes():
    points, quads = tube(around=4, along=5)
    flat = points * [1, 1, 0] * 0 + np.column_stack([points[:, 2], 2 * points[:, 2], points[:, 2] - 3])
    fine = all_vertices(flat, refine(points, quads))
    np.testing.assert_allclose(fine[:, 1], 2 * fine[:, 0], atol=1e-9)
    np.testing.assert_allclose(fine[:, 2], fine[:, 0] - 3, atol=1e-9)


def test_a_round_bar_becomes_sixteen_times_rounder():
    points, quads = tube()
    fine = all_vertices(points, refine(points, quads))
    middle = fine[(fine[:, 2] > 5) & (fine[:, 2] < 55)]
    coarse = 10 * (1 - np.cos(np.pi / 12))
    assert np.abs(np.linalg.norm(middle[:, :2], axis=1) - 10).max() < coarse / 16


def test_refined_muscles_are_closed_and_turn_outwards():
    mesh = preset_mesh(built_in_arm(), "biceps", "tiny")
    surface = page_surface(mesh.points, mesh.skin)
    assert surface.between is not None
    fine = all_vertices(mesh.points[surface.nodes], surface.between)
    edges = edges_of(surface.triangles)
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    assert volume(fine, surface.triangles) == pytest.approx(mesh.volume(), rel=0.1)


def test_sensors_below_the_skin_come_after_its_nodes():
    mesh = preset_mesh(built_in_arm(), "biceps", "tiny")
    skin = np.unique(mesh.skin)
    below = int(np.setdiff1d(np.arange(len(mesh.points)), skin)[0])
    surface = page_surface(mesh.points, mesh.skin, (int(skin[5]), below))
    assert surface.sensors == (5, surface.on_skin)
    assert surface.nodes[list(surface.sensors)].tolist() == [skin[5], below]


def test_a_body_without_a_skin_is_refused():
    with pytest.raises(InputError, match="expected a body with a skin"):
        page_surface(np.eye(3), np.zeros((0, 4), dtype=np.int64))


def test_an_enormous_surface_is_thinned_and_keeps_its_shape():
    bone = capsule(np.zeros(3), np.array([0.0, 0.0, 80.0]), 20.0, "bone", "#ffffff")
    triangles = triangles_of(bone.quads)
    kept, fewer = thin(bone.points, triangles, 200)
    assert 100 < len(kept) <= 200
    assert len(np.unique(kept)) == len(kept)
    assert volume(bone.points[kept], fewer) == pytest.approx(volume(bone.points, triangles), rel=0.1)


def test_thinning_is_told():
    mesh = preset_mesh(built_in_arm(), "biceps", "tiny")
    surface = page_surface(mesh.points, mesh.skin, (0,), most=40)
    assert surface.on_skin <= 40
    assert surface.left_out == len(np.unique(mesh.skin)) - surface.on_skin
    assert surface.nodes[surface.sensors[0]] == 0
    assert surface.triangles.max() < surface.on_skin
