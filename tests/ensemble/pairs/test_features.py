"""Features: their definitions by hand, and that what goes in comes out."""

import numpy as np
import pytest

from myograph.ensemble.pairs.features import FEATURES, FIELD, WIDTH, check_feature, feature, field_values, fields_of
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError
from tests.ensemble.pairs.made_up import NODES, made_up

PAIRS = np.array([[0, 3], [2, 2], [3, 1]])


@pytest.fixture
def cases():
    return made_up()


@pytest.mark.parametrize("kind", FEATURES)
def test_a_field_comes_back_from_its_feature(cases, kind):
    """The second pair is a case with itself: nothing moves there, and the direction has no length."""
    sampler = PairSampler(cases, random_sensors(NODES), asked=fields_of([kind]))
    batch = sampler.batch(PAIRS)
    values = feature(kind, batch.question.query_initial, batch.truth)
    assert values.shape == (3, NODES - 9, WIDTH[kind])
    back = field_values(kind, values, batch.question.query_initial)
    np.testing.assert_allclose(back, batch.truth[FIELD[kind]], atol=1e-12)


@pytest.mark.parametrize("given", FEATURES)
@pytest.mark.parametrize("wanted", FEATURES)
def test_any_feature_goes_in_with_any_other_out(cases, given, wanted):
    sampler = PairSampler(cases, random_sensors(NODES), known=fields_of([given]), asked=fields_of([wanted]))
    batch = sampler.batch(PAIRS)
    question = batch.question
    assert feature(given, question.sensor_initial, question.sensor_target).shape == (3, 9, WIDTH[given])
    assert feature(wanted, question.query_initial, batch.truth).shape == (3, NODES - 9, WIDTH[wanted])


def test_direction_and_scale_of_a_movement_of_3_4_12():
    """Length 13; a point that stays has neither direction nor scale."""
    start = {"position": np.array([[[1.0, 2.0, 3.0], [5.0, 5.0, 5.0]]])}
    end = {"position": start["position"] + np.array([[[3.0, 4.0, 12.0], [0.0, 0.0, 0.0]]])}
    found = feature("direction_and_scale", start, end)
    np.testing.assert_allclose(found, [[[3 / 13, 4 / 13, 12 / 13, 13], [0, 0, 0, 0]]], rtol=1e-15)


def test_a_direction_of_another_length_counts_as_a_direction():
    start = {"position": np.zeros((1, 1, 3))}
    moved = field_values("direction_and_scale", np.array([[[0.0, 5.0, 0.0, 2.0]]]), start)
    np.testing.assert_allclose(moved, [[[0, 2, 0]]])


def test_stresses_are_those_of_the_target_case(cases):
    sampler = PairSampler(cases, random_sensors(NODES), known=("von_mises", "cauchy_stress"))
    question = sampler.batch(PAIRS).question
    for kind in ("von_mises", "cauchy_stress"):
        told = feature(kind, question.sensor_initial, question.sensor_target)
        expected = cases.values(kind, PAIRS[:, 1])[:, sampler.sensors]
        np.testing.assert_array_equal(told.reshape(expected.shape), expected)


def test_fields_of_features_are_named_once():
    assert fields_of(["displacement", "coordinates", "von_mises"]) == ("position", "von_mises")


def test_unknown_features_missing_fields_and_wrong_widths_are_input_errors():
    points = {"position": np.zeros((1, 4, 3))}
    with pytest.raises(InputError, match=r"expected one of coordinates, .*got 'velocity'"):
        check_feature("velocity")
    with pytest.raises(InputError, match="'von_mises': expected the field 'von_mises', got position; make the sampler"):
        feature("von_mises", points, points)
    with pytest.raises(InputError, match="'direction_and_scale': expected 4 numbers at each point, got 3"):
        field_values("direction_and_scale", np.zeros((1, 4, 3)), points)
