"""Errors of positions: hand values, invariance, and what 'do nothing' scores."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from myograph.errors import InputError
from myograph.evaluation import Evaluation, NodeErrors, node_errors, stress_errors, summarise


def pairs(seed: int = 0, batch: int = 4, nodes: int = 30) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Predicted, true and initial positions [mm]."""
    random = np.random.default_rng(seed)
    initial = random.normal(size=(batch, nodes, 3)) * 50
    true = initial + random.normal(size=initial.shape) * 8
    return true + random.normal(size=initial.shape), true, initial


def test_error_of_a_node_is_its_euclidean_distance():
    """3-4-12 makes 13."""
    true = np.zeros((1, 2, 3))
    predicted = np.array([[[3.0, 4.0, 12.0], [0.0, 0.0, -2.0]]])
    np.testing.assert_array_equal(node_errors(predicted, true), np.array([[13.0, 2.0]], dtype=np.float32))


def test_summary_equals_figures_worked_out_by_hand():
    """Errors 0, 1, ..., 100: mean 50, rmse sqrt(100·101·201/6 / 101), 95th percentile 95, largest 100."""
    errors = np.arange(101, dtype=np.float32).reshape(1, -1)
    summary = Evaluation(NodeErrors(errors, scale=25.0)).summary()
    assert summary.mean_mm == 50
    assert summary.rmse_mm == pytest.approx(np.sqrt(100 * 201 / 6), rel=1e-7)
    assert summary.p95_mm == pytest.approx(95)
    assert summary.max_mm == 100
    assert summary.relative == 2


@given(seed=st.integers(0, 1000))
def test_doing_nothing_has_relative_error_1(seed):
    _, true, initial = pairs(seed)
    assert summarise(initial, true, initial).relative == pytest.approx(1, rel=1e-6)


@given(seed=st.integers(0, 1000))
def test_mean_is_below_rmse_and_95_percent_below_the_largest(seed):
    summary = summarise(*pairs(seed))
    assert 0 < summary.mean_mm <= summary.rmse_mm <= summary.max_mm
    assert summary.p95_mm <= summary.max_mm


def test_a_rigid_motion_of_everything_changes_no_figure():
    random = np.random.default_rng(3)
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    shift = random.normal(size=3) * 100
    still = summarise(*pairs())
    moved = summarise(*(positions @ rotation.T + shift for positions in pairs()))
    for name in ("mean_mm", "rmse_mm", "p95_mm", "max_mm", "relative"):
        assert getattr(moved, name) == pytest.approx(getattr(still, name), rel=1e-5)


def test_node_mean_is_the_mean_over_pairs_of_each_node():
    errors = np.array([[1.0, 2.0, 3.0], [3.0, 2.0, 7.0]], dtype=np.float32)
    np.testing.assert_array_equal(NodeErrors(errors, 1.0).node_mean, np.array([2, 2, 5], dtype=np.float32))


def test_shapes_that_differ_are_refused_with_both_shapes():
    with pytest.raises(InputError, match=r"\(1, 5, 3\).*got \(1, 4, 3\)"):
        node_errors(np.zeros((1, 4, 3)), np.zeros((1, 5, 3)))


@pytest.mark.parametrize("name", ["predicted", "true"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_positions_that_are_no_numbers_are_refused_by_name(name, bad):
    positions = {"predicted": np.zeros((1, 4, 3)), "true": np.zeros((1, 4, 3))}
    positions[name][0, 1, 2] = bad
    with pytest.raises(InputError, match=f"{name} positions.*1 of 12"):
        node_errors(**positions)


def test_stresses_that_differ_in_shape_or_are_no_numbers_are_refused():
    with pytest.raises(InputError, match=r"\(1, 5\) as the true stresses, got \(1, 4\)"):
        stress_errors(np.zeros((1, 4)), np.zeros((1, 5)))
    with pytest.raises(InputError, match="predicted stresses: expected finite numbers, got 1 of 4"):
        stress_errors(np.array([[0, 0, np.nan, 0]]), np.zeros((1, 4)))


def test_a_relative_error_needs_something_that_moves():
    still = np.zeros((1, 4, 3))
    with pytest.raises(InputError, match="nodes that move"):
        summarise(still, still, still)
