"""Gaussian processes on modes: they interpolate, and know how far off they are."""

import numpy as np
import pytest
import torch

from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.learning.baselines import pod_gp
from myograph.learning.baselines.gp_module import PodGpConfig, rebuild
from myograph.learning.baselines.pod import pod_of
from myograph.learning.baselines.pod_gp import PodGp
from myograph.learning.baselines.taught import taught
from tests.learning.baselines.stand_in import distances

SETTINGS = PodGpConfig(modes=8, kernel_cases=80)


@pytest.fixture(scope="module")
def fitted(body_sampler, off_grid):
    return PodGp(SETTINGS).fit(body_sampler, off_grid)


@pytest.fixture(scope="module")
def unseen(body_sampler, off_grid):
    return body_sampler.batch(off_grid.test[::7])


def test_a_smooth_movement_is_met_far_better_than_by_its_mean(fitted, unseen, body_sampler, off_grid):
    mean = taught(body_sampler, off_grid).fields["position"].mean(axis=0)[unseen.question.query_nodes]
    of_mean = np.linalg.norm(mean - unseen.truth["position"], axis=-1).mean()
    assert distances(fitted.predict(unseen.question), unseen).mean() < 0.1 * of_mean


def test_stress_is_met_better_than_by_its_mean(fitted, unseen, body_sampler, off_grid):
    truth = unseen.truth["von_mises"]
    mean = taught(body_sampler, off_grid).fields["von_mises"].mean(axis=0)[unseen.question.query_nodes, 0]
    assert (
        np.abs(fitted.predict(unseen.question).values["von_mises"] - truth).mean() < 0.3 * np.abs(mean - truth).mean()
    )


def test_training_cases_are_met_within_what_modes_and_noise_leave(fitted, body_sampler, off_grid):
    batch = body_sampler.batch(off_grid.train.all()[:80])
    answer = fitted.predict(batch.question)
    assert distances(answer, batch).mean() < 0.2
    assert answer.deviation["position"].mean() < 0.3


def test_the_deviation_is_of_the_size_of_the_error_and_grows_off_the_cases(fitted, unseen, body_sampler, off_grid):
    answer = fitted.predict(unseen.question)
    errors, deviation = distances(answer, unseen), answer.deviation["position"]
    assert 0.3 < np.sqrt(np.mean(errors**2) / np.mean(deviation**2)) < 3
    known = body_sampler.batch(off_grid.train.all()[:40]).question
    assert deviation.mean() > 1.5 * fitted.predict(known).deviation["position"].mean()


def test_the_module_answers_as_scikit_learn_does(fitted, body_sampler, off_grid):
    told = taught(body_sampler, off_grid)
    pod = pod_of(told.fields["position"], SETTINGS.modes)
    drawn = np.random.default_rng(SETTINGS.seed).permutation(len(told))
    activation, coefficients = told.activation[drawn], pod.coefficients[drawn] / pod.spread
    kernel = pod_gp._kernel_of(activation, coefficients[:, 0])
    reference = pod_gp.GaussianProcessRegressor(kernel, optimizer=None).fit(activation, coefficients)
    asked = np.random.default_rng(5).uniform(size=(4, 5)).astype(np.float32)
    mean, deviation = reference.predict(asked, return_std=True)
    values, _, spread, _ = fitted.module(torch.from_numpy(asked), torch.arange(60))
    np.testing.assert_allclose(values, pod.fields(mean * pod.spread), rtol=1e-5, atol=1e-4)
    share = np.sum(pod.spread**2 * np.sum(pod.modes**2, axis=-1).T, axis=-1)
    np.testing.assert_allclose(spread, np.sqrt(deviation[:, :1] ** 2 * share + pod.rest**2), rtol=1e-3, atol=1e-4)


def test_of_more_cases_some_are_drawn(body_sampler, off_grid):
    few = PodGp(PodGpConfig(modes=2, most_cases=12, kernel_cases=12)).fit(body_sampler, off_grid)
    assert few.module.processes["position"].weights.shape == (12, 2)


def test_every_muscle_has_a_length_and_the_deviation_stands_beside_each_field(fitted):
    assert fitted.module.processes["position"].lengths.shape == (5,)
    assert fitted.fields == ("position", "von_mises")
    assert fitted.signature.outputs == ("position", "von_mises", "position_deviation", "von_mises_deviation")


def test_method_and_result_keep_the_contracts_and_the_module_is_built_anew(fitted, unseen):
    assert isinstance(PodGp(), Learner)
    assert isinstance(fitted, Predictor)
    other = rebuild(fitted.config.model_dump(mode="json"), {})
    other.load_state_dict(fitted.module.state_dict())
    given = torch.full((2, 5), 0.3), torch.arange(7)
    for again, first in zip(other(*given), fitted.module(*given), strict=True):
        torch.testing.assert_close(again, first, rtol=0, atol=0)


def test_answers_do_not_depend_on_the_pairs_beside(fitted, body_sampler, off_grid):
    pairs = off_grid.test[:9]
    whole = fitted.predict(body_sampler.batch(pairs).question).values["position"]
    turned = fitted.predict(body_sampler.batch(pairs[::-1]).question).values["position"]
    np.testing.assert_allclose(turned[::-1], whole, rtol=1e-6)
