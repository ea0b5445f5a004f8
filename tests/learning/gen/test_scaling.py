"""Millimetres into the unit box, features to numbers near one."""

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.features import FEATURES, feature
from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.learning.gen.scaling import blank_scaling, fit_scaling

PAIRS = PairSet(np.array([0, 1]), np.array([2]))


def states(change=lambda positions: positions):
    """Four cases of 30 nodes in a body of about 300 x 60 x 40 mm."""
    draw = np.random.default_rng(0)
    positions = change(draw.uniform(size=(4, 30, 3)) * [60, 40, 300] + [-100, 50, 700])
    body = Body(positions[3], np.zeros((0, 4), dtype=np.int64), np.zeros((0, 8), dtype=np.int64))
    fields = {
        "position": positions,
        "von_mises": draw.uniform(size=(4, 30)),
        "cauchy_stress": 3 + 7 * draw.normal(size=(4, 30, 6)),
    }
    cases = cases_in_memory("biceps", body, np.zeros((4, 5)), ["factorial"] * 4, fields)
    return PairSampler(cases, np.array([3, 7]), "initial", tuple(fields), tuple(fields))


def scaled(sampler, scaling, kind):
    pairs = PAIRS.all()
    before, after = ({name: sampler.cases.values(name, pairs[:, role]) for name in sampler.asked} for role in (0, 1))
    units = scaling.features[kind]
    return (feature(kind, before, after) - units.offset) / units.unit


def test_the_box_is_that_of_the_cases_of_the_pairs_and_its_longest_side_is_the_length():
    sampler = states()
    scaling = fit_scaling(sampler, PAIRS, ["displacement"])
    used = sampler.cases.values("position", np.arange(3)).reshape(-1, 3)
    np.testing.assert_allclose(scaling.lowest, used.min(axis=0))
    np.testing.assert_allclose(scaling.lowest + scaling.sides, used.max(axis=0))
    assert scaling.length == np.ptp(used[:, 2])


def test_in_the_material_convention_the_box_is_that_of_the_body():
    sampler = states()
    material = PairSampler(sampler.cases, sampler.sensors, "material")
    scaling = fit_scaling(material, PAIRS, ["displacement"])
    np.testing.assert_allclose(scaling.sides, np.ptp(sampler.cases.body.reference, axis=0))


def test_displacements_and_scales_have_root_mean_square_one_and_directions_stay():
    sampler = states()
    scaling = fit_scaling(sampler, PAIRS, ["displacement", "direction_and_scale"])
    assert np.sqrt(np.square(scaled(sampler, scaling, "displacement")).mean()) == pytest.approx(1)
    values = scaled(sampler, scaling, "direction_and_scale")
    assert np.sqrt(np.square(values[..., 3]).mean()) == pytest.approx(1)
    np.testing.assert_allclose(np.linalg.norm(values[..., :3], axis=-1), 1)


def test_coordinates_are_centred_and_the_shortest_side_is_two():
    sampler = states()
    values = scaled(sampler, fit_scaling(sampler, PAIRS, ["coordinates"]), "coordinates").reshape(-1, 3)
    np.testing.assert_allclose(values.max(axis=0), -values.min(axis=0), rtol=1e-9)
    assert np.ptp(values, axis=0).min() == pytest.approx(2)


@pytest.mark.parametrize("kind", ["von_mises", "cauchy_stress"])
def test_stress_is_centred_and_its_components_are_scaled_alike(kind):
    sampler = states()
    scaling = fit_scaling(sampler, PAIRS, [kind])
    values = scaled(sampler, scaling, kind)
    width = values.shape[-1]
    np.testing.assert_allclose(values.reshape(-1, width).mean(axis=0), 0, atol=1e-9)
    assert values.reshape(-1, width).std(axis=0).max() == pytest.approx(1)
    assert len(set(scaling.features[kind].unit.tolist())) == 1


def test_stress_that_is_the_same_everywhere_has_the_unit_one():
    sampler = states()
    same = {"position": sampler.cases.values("position", np.arange(4)), "von_mises": np.full((4, 30), 0.3)}
    cases = cases_in_memory("biceps", sampler.cases.body, np.zeros((4, 5)), ["factorial"] * 4, same)
    still = PairSampler(cases, sampler.sensors, "initial", ("position",), ("von_mises",))
    assert fit_scaling(still, PAIRS, ["von_mises"]).features["von_mises"].unit.tolist() == [1.0]


def test_cases_outside_the_pairs_are_not_looked_at():
    def spoil(positions):
        positions[3] *= 10
        return positions

    one, two = (fit_scaling(sampler, PAIRS, ["displacement"]) for sampler in (states(), states(spoil)))
    np.testing.assert_array_equal(one.sides, two.sides)
    np.testing.assert_array_equal(one.features["displacement"].unit, two.features["displacement"].unit)


def test_a_flat_body_is_an_input_error():
    def flatten(positions):
        positions[..., 1] = 5.0
        return positions

    with pytest.raises(InputError, match="expected a body in space"):
        fit_scaling(states(flatten), PAIRS, ["displacement"])


def test_pairs_between_which_nothing_moves_are_an_input_error():
    still = PairSet(np.array([0]), np.array([0]))
    with pytest.raises(InputError, match="expected pairs of cases between which something moves, got 1"):
        fit_scaling(states(), still, ["coordinates"])


def test_a_blank_scaling_changes_nothing():
    blank = blank_scaling(FEATURES)
    assert blank.length == 1
    assert all((units.offset == 0).all() and (units.unit == 1).all() for units in blank.features.values())
