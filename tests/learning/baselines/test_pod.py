"""Modes: exact on what they span, and the best of their number."""

import numpy as np
import pytest

from myograph.learning.baselines.pod import pod_of


@pytest.fixture
def of_rank_four():
    """30 cases of 12 nodes: a mean and four modes."""
    draw = np.random.default_rng(0)
    modes = draw.normal(size=(4, 12, 3))
    return 100 + np.tensordot(draw.normal(size=(30, 4)) * [9, 3, 1, 0.1], modes, 1)


def test_as_many_modes_as_the_rank_leave_nothing_and_no_more_are_kept(of_rank_four):
    pod = pod_of(of_rank_four, 20)
    assert len(pod.modes) == 4
    np.testing.assert_allclose(pod.fields(pod.coefficients), of_rank_four, atol=1e-9)
    np.testing.assert_allclose(pod.rest, 0, atol=1e-9)


def test_modes_are_orthonormal_and_sorted_by_strength(of_rank_four):
    pod = pod_of(of_rank_four, 3)
    flat = pod.modes.reshape(3, -1)
    np.testing.assert_allclose(flat @ flat.T, np.eye(3), atol=1e-10)
    assert (np.diff(pod.spread) < 0).all()


def test_modes_are_those_of_the_singular_value_decomposition(of_rank_four):
    pod = pod_of(of_rank_four, 2)
    centred = (of_rank_four - of_rank_four.mean(axis=0)).reshape(30, -1)
    left, strengths, right = np.linalg.svd(centred, full_matrices=False)
    best = (left[:, :2] * strengths[:2]) @ right[:2]
    np.testing.assert_allclose(pod.fields(pod.coefficients) - pod.mean, best.reshape(30, 12, 3), atol=1e-9)
    rest = np.sqrt(np.mean(np.sum((centred - best).reshape(30, 12, 3) ** 2, axis=-1), axis=0))
    np.testing.assert_allclose(pod.rest, rest, atol=1e-9)
