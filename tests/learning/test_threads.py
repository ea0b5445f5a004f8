"""Fits whose matrices are small keep to one thread, whatever the program has."""

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.learning.baselines import gappy_pod, pod_gp
from myograph.learning.baselines.gappy_pod import GappyPod
from myograph.learning.baselines.pod_gp import PodGp
from myograph.learning.modes import fitting, learner
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.threads import on_one_thread
from tests.learning.modes.block import block


def threads():
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


def test_linear_algebra_has_one_thread_while_the_work_lasts():
    @on_one_thread
    def work(size, *, scale):
        """Some."""
        return threads(), scale * np.eye(size)

    with threadpool_limits(limits=2, user_api="blas"):
        during, answer = work(2, scale=3.0)
        assert threads() == {2}
    assert during == {1}
    assert np.array_equal(answer, 3 * np.eye(2))
    assert work.__doc__ == "Some."


def test_an_error_gives_the_threads_back():
    @on_one_thread
    def work():
        raise ValueError("no")

    with threadpool_limits(limits=2, user_api="blas"):
        with pytest.raises(ValueError, match="no"):
            work()
        assert threads() == {2}


class ReachedError(Exception):
    """Where a fit was stopped."""


@pytest.mark.parametrize(
    ("learner", "module", "inner"),
    [
        (PodGp(), pod_gp, "taught"),
        (GappyPod(), gappy_pod, "taught_cases"),
        (ModesLearner(), learner, "proper_modes"),
        (ModesLearner(ModesConfig(modes=4)), fitting, "fit_network"),
    ],
)
def test_fits_of_small_matrices_keep_to_it(learner, module, inner, monkeypatch):
    during = []

    def reached(*_arguments, **_options):
        during.append(threads())
        raise ReachedError

    monkeypatch.setattr(module, inner, reached)
    cases = block()
    sampler = PairSampler(cases, np.array([0, 8, 13, 20]), "material")
    with threadpool_limits(limits=2, user_api="blas"), pytest.raises(ReachedError):
        learner.fit(sampler, split_pairs(cases, "off_grid"))
    assert during == [{1}]
