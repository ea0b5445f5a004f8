"""Fields and their derivatives at integration points."""

import numpy as np
import pytest

from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.learning.physics.points import random_points
from tests.learning.physics.body import bar


def test_a_quadratic_field_and_its_derivative_are_exact():
    body = bar()
    points = random_points(body, np.random.default_rng(0), 20)
    places = points.carry(body.reference[None])[0]
    x, y, z = body.reference.T
    field = np.stack([x * y, z**2, x + 3 * z, y * z], axis=-1)[None]
    x, y, z = places.T
    zero, one = 0 * x, np.ones_like(x)
    wanted = np.stack([[y, x, zero], [zero, zero, 2 * z], [one, zero, 3 * one], [zero, z, y]])
    np.testing.assert_allclose(points.carry(field)[0], np.stack([x * y, z**2, x + 3 * z, y * z], axis=-1))
    np.testing.assert_allclose(points.gradient(field)[0], np.moveaxis(wanted, -1, 0), atol=1e-9)


def test_points_are_drawn_from_all_elements():
    points = random_points(bar(), np.random.default_rng(0), 60)
    assert set(points.nodes[:, 0]) == {0, 18, 36}


def test_a_body_without_elements_is_an_input_error():
    with pytest.raises(InputError, match="expected 27 or 10 nodes each, got 0"):
        random_points(Body(bar().reference, bar().skin, np.zeros((0, 27), dtype=np.int64)), np.random.default_rng(0), 1)
