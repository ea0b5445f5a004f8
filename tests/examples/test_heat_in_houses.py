"""Heat in houses: the solver against a closed form, the network against answering with the mean."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("torch", reason="the example needs torch")
PATH = Path(__file__).parents[2] / "examples" / "heat_in_houses.py"


@pytest.fixture(scope="module")
def heat():
    spec = importlib.util.spec_from_file_location("heat_in_houses", PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_stiffness_of_a_linear_temperature_along_the_wall_is_zero_inside(heat):
    """u = y solves the equation, as no heat crosses the wall."""
    residual = (heat.stiffness() @ heat.PLACES[..., 1].ravel()).reshape(heat.OUTSIDE.shape)
    np.testing.assert_allclose(residual[~heat.OUTSIDE], 0, atol=1e-9)


def test_heat_in_houses(heat):
    """A small network on few houses already has less than a fifth of the error of answering with the mean."""
    error, error_of_mean = heat.errors(houses=200, steps=150, nodes_per_axis=4)
    assert error_of_mean == pytest.approx(0.917, rel=0.01)
    assert error < 0.2 * error_of_mean
