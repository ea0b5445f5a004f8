"""Gappy POD: exact on what the training cases span, from any sensors that can tell."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.inference.loaded import load
from myograph.learning.baselines import GappyPod, ThinPlateSpline
from myograph.learning.saveable import Saveable
from myograph.learning.saving import Training, load_torch, save_model
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
    assert fitted.config.kept_modes == 5
    assert distances(fitted.predict((batch := sampler.batch(split.test)).question), batch).max() < 1e-3


def test_two_sensors_are_enough_for_five_modes(spanned, fitted):
    sampler, split = spanned
    fewer = PairSampler(sampler.cases, sampler.sensors[:2])
    assert distances(fitted.predict((batch := fewer.batch(split.test)).question), batch).max() < 1e-2


def test_one_sensor_gives_an_answer_nearer_than_the_mean_position(spanned, fitted):
    sampler, split = spanned
    batch = PairSampler(sampler.cases, sampler.sensors[:1]).batch(split.test)
    mean = fitted.module.mean.numpy()
    of_mean = np.linalg.norm(mean[batch.question.query_nodes] - batch.truth["position"], axis=-1)
    assert distances(fitted.predict(batch.question), batch).mean() < of_mean.mean()


def test_a_bending_body_is_met_better_than_by_a_spline(body_cases):
    sampler, split = stand_in_sampler("initial", cases=body_cases), split_pairs(body_cases, "off_grid")
    batch = sampler.batch(split.test)
    spline = distances(ThinPlateSpline().predict(batch.question), batch).mean()
    assert distances(GappyPod().fit(sampler, split).predict(batch.question), batch).mean() < 0.1 * spline


def test_both_conventions_give_the_same_answer(spanned):
    sampler, split = spanned
    answers = []
    for convention in ("initial", "material"):
        named = replace(sampler, convention=convention)
        answers.append(GappyPod().fit(named, split).predict(named.batch(split.test).question).values["position"])
    np.testing.assert_array_equal(*answers)


def test_answers_do_not_depend_on_the_pairs_beside(spanned, fitted):
    sampler, split = spanned
    whole = fitted.predict(sampler.batch(split.test).question).values["position"]
    turned = fitted.predict(sampler.batch(split.test[::-1]).question).values["position"]
    np.testing.assert_allclose(turned[::-1], whole, rtol=1e-6)


def test_method_and_result_keep_the_contracts(fitted):
    assert isinstance(GappyPod(), Learner)
    assert isinstance(fitted, Predictor)
    assert isinstance(fitted, Saveable)
    assert fitted.stored == 60 * 3 * (1 + 5) + 5
    assert fitted.parameters == 0


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
    with pytest.raises(InputError, match="sensor_position_target: expected finite numbers"):
        fitted.predict(replace(question, sensor_target={"position": broken}))


def test_no_sensor_at_all_is_an_input_error(spanned, fitted):
    sampler, split = spanned
    question = sampler.batch(split.test[:1]).question
    none = {
        role: {"position": getattr(question, role)["position"][:, :0]} for role in ("sensor_initial", "sensor_target")
    }
    without = replace(
        question, sensor_nodes=question.sensor_nodes[:0], sensor_places=question.sensor_places[:, :0], **none
    )
    with pytest.raises(InputError, match="expected at least 1 sensors, got 0"):
        fitted.predict(without)


def test_a_saved_one_answers_the_same_in_torch_and_in_onnxruntime(spanned, fitted, tmp_path):
    pytest.importorskip("onnxscript")
    sampler, split = spanned
    told = save_model(fitted, Training(sampler.cases, split), tmp_path / "model")
    assert (told.method, told.parameters) == ("gappy_pod", fitted.parameters)
    assert told.parity < 1e-5
    question = sampler.batch(split.test[:3]).question
    wanted = fitted.predict(question).values["position"]
    np.testing.assert_array_equal(load_torch(tmp_path / "model").predict(question).values["position"], wanted)
    alone = load(tmp_path / "model").predict(question).values["position"]
    np.testing.assert_allclose(alone, wanted, atol=1e-3)
