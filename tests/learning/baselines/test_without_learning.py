"""What sensors alone can tell: exact where the movement is of the method's own kind."""

import numpy as np
import pytest

from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.errors import InputError
from myograph.learning.baselines import BASELINES, Affine, DoNothing, ThinPlateSpline
from tests.learning.baselines.stand_in import bodies_cases, question, stand_in_sampler

SPATIAL = [Affine(), ThinPlateSpline()]
MAP = np.array([[0.9, 0.3, -0.1], [-0.2, 1.1, 0.0], [0.1, 0.2, 0.8]])
SHIFT = np.array([10.0, -4.0, 250.0])


def moved(points):
    return points @ MAP.T + SHIFT


@pytest.fixture
def places():
    """Sensors (2, 9, 3) and queries (2, 30, 3) in a body of 300 mm."""
    draw = np.random.default_rng(0)
    return draw.normal(size=(2, 9, 3)) * [20, 20, 100], draw.normal(size=(2, 30, 3)) * [20, 20, 100]


def test_doing_nothing_answers_where_the_points_were_in_both_conventions():
    cases = bodies_cases()
    for convention in ("initial", "material"):
        asked = stand_in_sampler(convention, ("position", "von_mises"), cases).batch(np.array([[0, 31]])).question
        answer = DoNothing().predict(asked)
        for name in ("position", "von_mises"):
            np.testing.assert_array_equal(answer.values[name], cases.values(name, np.array([0]))[:, asked.query_nodes])


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_an_affine_movement_is_found_exactly(method, places):
    sensors, queries = places
    answer = method.predict(question(sensors, moved(sensors), queries))
    np.testing.assert_allclose(answer.values["position"], moved(queries), rtol=1e-8)


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_an_affine_state_is_found_exactly_from_material_places(method):
    reference = bodies_cases().body.reference
    sensors, queries = np.stack([reference[:9]] * 2), np.stack([reference[9:]] * 2)
    answer = method.predict(question(sensors, moved(sensors), queries, "material"))
    np.testing.assert_allclose(answer.values["position"], moved(queries), rtol=1e-8)


def test_the_spline_takes_every_sensor_to_its_place_whatever_the_movement(places):
    sensors, _ = places
    targets = np.random.default_rng(1).normal(size=sensors.shape) * 50
    answer = ThinPlateSpline().predict(question(sensors, targets, sensors))
    np.testing.assert_allclose(answer.values["position"], targets, atol=1e-6)


def test_the_affine_map_is_the_one_with_the_least_squares(places):
    sensors, _ = places
    targets = np.random.default_rng(1).normal(size=sensors.shape) * 50
    residuals = Affine().predict(question(sensors, targets, sensors)).values["position"] - targets
    with_one = np.concatenate([sensors, np.ones((2, 9, 1))], axis=-1)
    np.testing.assert_allclose(with_one.transpose(0, 2, 1) @ residuals, 0, atol=1e-8)


def test_each_method_stands_under_its_name_and_needs_no_learning():
    sampler = stand_in_sampler()
    split = split_pairs(sampler.cases, "strict")
    assert list(BASELINES) == ["do_nothing", "affine", "thin_plate_spline"]
    for name, method in BASELINES.items():
        assert isinstance(method, Predictor)
        assert isinstance(method, Learner)
        assert method.name == name
        assert method.fit(sampler, split) is method


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_answers_do_not_depend_on_the_pairs_beside(method, places):
    sensors, queries = places
    targets = sensors + np.random.default_rng(1).normal(size=sensors.shape)
    both = method.predict(question(sensors, targets, queries)).values["position"]
    turned = method.predict(question(sensors[::-1], targets[::-1], queries[::-1])).values["position"]
    np.testing.assert_allclose(turned[::-1], both, rtol=1e-12)


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_fewer_than_four_sensors_are_an_input_error(method, places):
    sensors, queries = places
    with pytest.raises(InputError, match="at least 4 sensors, got 3"):
        method.predict(question(sensors[:, :3], sensors[:, :3], queries))


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_sensors_in_one_plane_are_an_input_error(method, places):
    sensors, queries = places
    sensors[1, :, 0] = 7.0
    with pytest.raises(InputError, match="pair 1: expected sensors that span a volume"):
        method.predict(question(sensors, sensors, queries))


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_two_sensors_at_one_place_are_an_input_error(method, places):
    sensors, queries = places
    sensors[1, 4] = sensors[1, 2]
    with pytest.raises(InputError, match="pair 1: expected 9 sensors at different places, got 8"):
        method.predict(question(sensors, sensors, queries))


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
@pytest.mark.parametrize("part", [0, 1, 2])
def test_positions_that_are_not_finite_are_an_input_error(method, part, places):
    parts = [places[0], places[0].copy(), places[1]]
    parts[part][0, 0, 0] = np.nan
    with pytest.raises(InputError, match="expected finite positions in mm, got NaN"):
        method.predict(question(*parts))
