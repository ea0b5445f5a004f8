"""Millimetres into the unit box and back."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.scaling import fit_scaling

TARGETS = ["coordinates", "displacement"]
PAIRS = np.array([[0, 1], [1, 0], [0, 2]])


@pytest.fixture
def positions():
    """Four cases of 30 nodes in a body of about 300 x 60 x 40 mm."""
    return np.random.default_rng(0).uniform(size=(4, 30, 3)) * [60, 40, 300] + [-100, 50, 700]


@pytest.mark.parametrize("target", TARGETS)
def test_into_the_box_and_out_again_is_the_identity(positions, target):
    scaling = fit_scaling(positions, PAIRS, target)
    np.testing.assert_allclose(scaling.out_of_box(scaling.into_box(positions)), positions, rtol=1e-12)


@pytest.mark.parametrize("target", TARGETS)
def test_values_and_back_is_the_identity(positions, target):
    scaling = fit_scaling(positions, PAIRS, target)
    values = scaling.values(positions[0], positions[1])
    np.testing.assert_allclose(scaling.targets(positions[0], values), positions[1], rtol=1e-12)


def test_all_distances_shrink_by_the_same_factor(positions):
    scaling = fit_scaling(positions, PAIRS, "displacement")
    inside = scaling.into_box(positions)
    shrunk = np.linalg.norm(inside[0] - inside[1], axis=-1) / np.linalg.norm(positions[0] - positions[1], axis=-1)
    np.testing.assert_allclose(shrunk, 1 / scaling.length, rtol=1e-9)


def test_the_longest_side_becomes_one(positions):
    scaling = fit_scaling(positions, PAIRS, "displacement")
    inside = scaling.into_box(positions[:3])
    assert inside.min() == 0
    assert inside.max() == pytest.approx(1)
    np.testing.assert_allclose(np.ptp(inside.reshape(-1, 3), axis=0), scaling.unit_sides)


def test_displacements_have_root_mean_square_one_over_the_pairs(positions):
    scaling = fit_scaling(positions, PAIRS, "displacement")
    values = scaling.values(positions[PAIRS[:, 0]], positions[PAIRS[:, 1]])
    assert np.sqrt(np.square(values).mean()) == pytest.approx(1)


def test_coordinates_are_centred_and_the_shortest_side_is_two(positions):
    values = fit_scaling(positions, PAIRS, "coordinates").values(positions[:3], positions[:3]).reshape(-1, 3)
    np.testing.assert_allclose(values.max(axis=0), -values.min(axis=0), rtol=1e-9)
    assert np.ptp(values, axis=0).min() == pytest.approx(2)


@pytest.mark.parametrize("target", TARGETS)
def test_cases_outside_the_pairs_are_not_looked_at(positions, target):
    before = fit_scaling(positions, PAIRS, target)
    positions[3] *= 10
    assert fit_scaling(positions, PAIRS, target) == before


def test_a_flat_body_is_an_input_error(positions):
    positions[..., 1] = 5.0
    with pytest.raises(InputError, match="expected a body in space"):
        fit_scaling(positions, PAIRS, "displacement")


def test_pairs_between_which_nothing_moves_are_an_input_error(positions):
    with pytest.raises(InputError, match="expected pairs of cases between which something moves, got 2"):
        fit_scaling(positions, np.array([[0, 0], [1, 1]]), "coordinates")
