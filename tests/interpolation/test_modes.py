"""Few modes for many numbers."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation import compress


def _data(states=20, n=300):
    """Three strong modes and a weak one."""
    rng = np.random.default_rng(4)
    time = np.linspace(0, 1, states)[:, None]
    shapes = rng.normal(size=(4, n))
    return (
        50
        + 9 * np.sin(3 * time) * shapes[0]
        + 4 * time**2 * shapes[1]
        + np.cos(5 * time) * shapes[2]
        + (1e-4 * np.sin(9 * time) * shapes[3])
    )


@pytest.mark.parametrize("weights", [None, np.linspace(0.1, 3, 300)])
def test_the_fewest_modes_within_the_tolerance(weights):
    values = _data()
    modes = compress(values, 1e-2, weights)
    error = np.abs(modes.expand(modes.coefficients) - values).max()
    assert modes.vectors.shape == (3, 300)
    assert modes.coefficients.shape == (20, 3)
    assert modes.largest_error == pytest.approx(error)
    assert error <= 1e-2
    two = np.abs(modes.mean + modes.coefficients[:, :2] @ modes.vectors[:2] - values).max()
    assert two > 1e-2


def test_vectors_are_orthonormal_in_the_weights():
    weights = np.linspace(0.1, 3, 300)
    modes = compress(_data(), 1e-6, weights)
    assert (modes.vectors * weights) @ modes.vectors.T == pytest.approx(np.eye(4), abs=1e-12)


def test_weights_say_where_the_modes_look():
    """One mode: that of the entry with the larger weight."""
    values = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    assert np.abs(compress(values, 1.0, np.array([1.0, 4.0])).vectors).shape == (0, 2)
    values[:2] *= 1.5
    assert np.abs(compress(values, 1.2).vectors) == pytest.approx(np.array([[1, 0]]))
    first = compress(values, 1e-9, np.array([1.0, 4.0])).vectors[0]
    assert np.abs(first) == pytest.approx([0, 0.5])


def test_constant_data_need_no_mode_and_one_state_neither():
    assert compress(np.full((4, 6), 3.0), 1e-9).vectors.shape == (0, 6)
    assert compress(np.ones((1, 6)), 1e-9).expand(np.empty((2, 0))) == pytest.approx(np.ones((2, 6)))


def test_bad_data_are_refused():
    values = _data()
    with pytest.raises(InputError, match="expected a tolerance above the rounding error"):
        compress(values, 0.0)
    with pytest.raises(InputError, match=r"rounding error .* got nan"):
        compress(values, float("nan"))
    with pytest.raises(InputError, match=r"data of shape \(states, n\), got \(0, 6\)"):
        compress(np.empty((0, 6)), 1.0)
    with pytest.raises(InputError, match="expected finite positive weights, got 0"):
        compress(values, 1.0, np.arange(300.0))
    with pytest.raises(InputError, match="expected 300 weights, got 299"):
        compress(values, 1.0, np.ones(299))
    values[7:9, 3] = np.nan
    with pytest.raises(InputError, match="got 2 states that are not, the first is state 7"):
        compress(values, 1.0)


def test_single_precision_costs_no_more_than_its_rounding():
    values = 100 * np.random.default_rng(1).normal(size=(6, 50))
    modes = compress(values, 1e-9)
    rounded = modes.rounded()
    assert rounded.vectors.dtype == np.float32
    assert rounded.expand(rounded.coefficients) == pytest.approx(values, abs=1e-4)
    assert np.abs(rounded.expand(rounded.coefficients) - values).max() > 1e-9
