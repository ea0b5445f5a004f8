"""What sensors alone can tell: exact where the movement is of the method's own kind."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.baselines import BASELINES, Affine, DoNothing, ThinPlateSpline

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


def told(sensors):
    return np.concatenate([sensors, moved(sensors)], axis=-1)


def test_doing_nothing_answers_with_the_question(places):
    sensors, queries = places
    np.testing.assert_array_equal(DoNothing().predict(told(sensors), queries), queries)


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_an_affine_movement_is_found_exactly(method, places):
    sensors, queries = places
    np.testing.assert_allclose(method.predict(told(sensors), queries), moved(queries), rtol=1e-8)


def test_the_spline_takes_every_sensor_to_its_place_whatever_the_movement(places):
    sensors, _ = places
    targets = np.random.default_rng(1).normal(size=sensors.shape) * 50
    answers = ThinPlateSpline().predict(np.concatenate([sensors, targets], axis=-1), sensors)
    np.testing.assert_allclose(answers, targets, atol=1e-6)


def test_the_affine_map_is_the_one_with_the_least_squares(places):
    sensors, _ = places
    targets = np.random.default_rng(1).normal(size=sensors.shape) * 50
    samples = np.concatenate([sensors, targets], axis=-1)
    residuals = Affine().predict(samples, sensors) - targets
    with_one = np.concatenate([sensors, np.ones((2, 9, 1))], axis=-1)
    np.testing.assert_allclose(with_one.transpose(0, 2, 1) @ residuals, 0, atol=1e-8)


def test_each_method_stands_under_its_name():
    assert {name: method.name for name, method in BASELINES.items()} == {name: name for name in BASELINES}


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_fewer_than_four_sensors_are_an_input_error(method, places):
    sensors, queries = places
    with pytest.raises(InputError, match="at least 4 sensors, got 3"):
        method.predict(told(sensors[:, :3]), queries)


@pytest.mark.parametrize("method", SPATIAL, ids=lambda method: method.name)
def test_sensors_in_one_plane_are_an_input_error(method, places):
    sensors, queries = places
    sensors[1, :, 0] = 7.0
    with pytest.raises(InputError, match="sample 1: expected sensors that span a volume"):
        method.predict(told(sensors), queries)
