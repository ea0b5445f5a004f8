"""Gappy POD: exact on what the training cases span, from any sensors that can tell."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.baselines import GappyPod, ThinPlateSpline
from tests.learning.baselines.stand_in import bodies_cases, distances, stand_in_sampler


@pytest.fixture(scope="module")
def spanned():
    """Every position is the reference and a mixture of five fields."""
    cases = bodies_cases()
    fields = np.random.default_rng(2).normal(size=(5, cases.nodes, 3))
    position = cases.body.reference + np.tensordot(cases.activation * [9, 7, 5, 3, 1], fields, 1)
    cases = cases_in_memory("biceps", cases.body, cases.activation, cases.design, {"position": position})
    return stand_in_sampler(cases=cases), split_pairs(cases, "strict")


@pytest.fixture(scope="module")
def fitted(spanned):
    return GappyPod().fit(*spanned)


def test_cases_in_the_span_of_the_training_cases_are_found_exactly(spanned, fitted):
    sampler, split = spanned
    assert len(fitted.modes) == 5
    assert distances(fitted.predict((batch := sampler.batch(split.test)).question), batch).max() < 1e-3


def test_two_sensors_are_enough_for_five_modes(spanned, fitted):
    sampler, split = spanned
    fewer = PairSampler(sampler.cases, sampler.sensors[:2])
    assert distances(fitted.predict((batch := fewer.batch(split.test)).question), batch).max() < 1e-2


def test_one_sensor_gives_an_answer_nearer_than_the_mean_position(spanned, fitted):
    sampler, split = spanned
    batch = PairSampler(sampler.cases, sampler.sensors[:1]).batch(split.test)
    of_mean = np.linalg.norm(fitted.mean[batch.question.query_nodes] - batch.truth["position"], axis=-1)
    assert distances(fitted.predict(batch.question), batch).mean() < of_mean.mean()


def test_a_bending_body_is_met_better_than_by_a_spline(body_cases):
    sampler, split = stand_in_sampler("initial", cases=body_cases), split_pairs(body_cases, "off_grid")
    batch = sampler.batch(split.test)
    spline = distances(ThinPlateSpline().predict(batch.question), batch).mean()
    assert distances(GappyPod().fit(sampler, split).predict(batch.question), batch).mean() < 0.1 * spline


def test_both_conventions_give_the_same_answer(spanned, fitted):
    sampler, split = spanned
    answers = [
        fitted.predict(replace(sampler, convention=convention).batch(split.test).question).values["position"]
        for convention in ("initial", "material")
    ]
    np.testing.assert_array_equal(*answers)


def test_answers_do_not_depend_on_the_pairs_beside(spanned, fitted):
    sampler, split = spanned
    whole = fitted.predict(sampler.batch(split.test).question).values["position"]
    turned = fitted.predict(sampler.batch(split.test[::-1]).question).values["position"]
    np.testing.assert_allclose(turned[::-1], whole, rtol=1e-12)


def test_method_and_result_keep_the_contracts(fitted):
    assert isinstance(GappyPod(), Learner)
    assert isinstance(fitted, Predictor)
    assert fitted.parameters == fitted.mean.size + fitted.modes.size + fitted.spread.size


def test_nodes_of_another_body_are_an_input_error(spanned, fitted):
    sampler, split = spanned
    question = sampler.batch(split.test[:1]).question
    with pytest.raises(InputError, match="expected the nodes 0 to 59 of its body, got"):
        fitted.predict(replace(question, query_nodes=question.query_nodes + 9))


def test_a_sensor_that_is_not_finite_is_an_input_error(spanned, fitted):
    sampler, split = spanned
    question = sampler.batch(split.test[:1]).question
    broken = question.sensor_target["position"].copy()
    broken[0, 0, 0] = np.inf
    with pytest.raises(InputError, match="expected finite positions"):
        fitted.predict(replace(question, sensor_target={"position": broken}))
