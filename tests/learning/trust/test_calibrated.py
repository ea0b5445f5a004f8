"""Held-out cases calibrate intervals and verdicts of any method."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.inference.ways import WHOLE, told_only
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.trust.calibrated import CalibratedLearner, edge_weights, enough, hold_out
from myograph.learning.trust.coverage import coverage
from myograph.learning.trust.nearness import nearness
from tests.learning.modes.conftest import QUICK
from tests.learning.trust.guessers import Guesser


@pytest.fixture(scope="module")
def sensing(sampler, split):
    """Neural modes of sensors, calibrated."""
    return CalibratedLearner(ModesLearner(ModesConfig(reads="sensors", **QUICK))).fit(sampler, split)


@pytest.fixture(scope="module")
def told_both(sampler, split):
    """Neural modes of activations and sensors, calibrated."""
    return CalibratedLearner(ModesLearner(ModesConfig(reads="both", **QUICK)), share=0.3).fit(sampler, split)


def test_held_out_cases_are_support_cases_and_teach_nothing(block_cases, split):
    rest, held_out = hold_out(block_cases, split, 0.15, 0)
    assert set(held_out) <= set(block_cases.named("support"))
    assert not set(held_out) & set(rest.train.cases)
    assert set(held_out) | set(rest.train.cases) == set(split.train.cases)
    assert len(held_out) == round(0.15 * len(split.train.cases))


def test_without_enough_support_cases_any_training_cases_are_held_out(block_cases, split):
    factorial = replace(split, train=PairSet(block_cases.named("factorial"), block_cases.named("factorial")))
    assert set(hold_out(block_cases, factorial, 0.5, 0)[1]) <= set(block_cases.named("factorial"))


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_a_share_that_leaves_nothing_is_refused(block_cases, split, share):
    with pytest.raises(InputError, match="holds out some of"):
        hold_out(block_cases, split, share, 0)


def test_holding_out_all_initial_cases_is_refused(block_cases, split):
    support = block_cases.named("support")
    lopsided = replace(split, train=PairSet(support[:1], support[:10]))
    with pytest.raises(InputError, match="beside the 9 held out"):
        hold_out(block_cases, lopsided, 0.9, 0)


def test_a_case_at_the_ends_of_activations_stands_for_half_a_step_of_each():
    activation = np.array([[0.1, 0.5, 0.9, 0.3, 0.3], [0.0, 0.5, 0.9, 0.3, 1.0]])
    assert edge_weights(activation).tolist() == [1, 0.25]


@pytest.fixture
def mostly_corners(block_cases):
    """Three of four cases at corners of the cube, where a case weighs a 32nd."""
    activation = np.round(block_cases.activation)
    activation[::4] = 0.5
    return replace(block_cases, activation=activation)


def test_nine_held_out_cases_are_enough_only_if_they_weigh_alike(block_cases, mostly_corners, split):
    share = 12 / len(split.train.cases)
    weights = edge_weights(mostly_corners.activation[hold_out(mostly_corners, split, share, 0)[1]])
    assert (len(weights), weights.max()) == (12, 1)
    assert weights.sum() < 9
    assert not enough(mostly_corners, split, share)
    assert enough(mostly_corners, split, 0.6)
    middle = replace(block_cases, activation=np.full_like(block_cases.activation, 0.5))
    assert enough(middle, split, share)
    assert not enough(middle, split, 8 / len(split.train.cases))
    assert not enough(middle, split, 0.0)


def test_too_few_cases_to_calibrate_on_are_refused_before_anything_is_learned(mostly_corners, split):
    class Eager(Guesser):
        def fit(self, sampler, split, progress=None):
            pytest.fail("it was taught")

    sampler = PairSampler(mostly_corners, np.array([0, 8, 13, 20]))
    with pytest.raises(InputError, match="expected cases enough for 90 %, such as 9 of equal weight, got 12"):
        CalibratedLearner(Eager(0.0), 12 / len(split.train.cases)).fit(sampler, split)


def test_intervals_of_a_method_without_deviations_have_one_width(sampler, split):
    answer = CalibratedLearner(Guesser(1.0)).fit(sampler, split).predict(sampler.batch(split.test[:3]).question)
    assert np.ptp(answer.half_width_90["position"]) == 0


def test_intervals_scale_with_the_deviations_that_the_method_says(sampler, split):
    narrow = CalibratedLearner(Guesser(1.0, 0.5)).fit(sampler, split)
    wide = CalibratedLearner(Guesser(1.0, 2.0)).fit(sampler, split)
    assert narrow.factors["position"] == pytest.approx(4 * wide.factors["position"])


def test_each_way_of_telling_a_method_is_calibrated_by_itself(told_both, sampler, split):
    assert set(told_both.factors_from) == {"activation", "sensors"}
    told = (told_both.factors, *told_both.factors_from.values())
    assert len({factors["position"] for factors in told}) == 3
    question = sampler.batch(split.test[:3]).question
    for way, factors in ((WHOLE, told_both.factors), *told_both.factors_from.items()):
        answer = told_both.predict(told_only(question, way))
        times = answer.half_width_90["position"] / answer.deviation["position"]
        np.testing.assert_allclose(times, factors["position"], rtol=1e-6)


def test_methods_that_are_told_in_one_way_have_one_factor(sensing):
    assert sensing.factors_from == {}


def test_nine_in_ten_nodes_of_the_calibration_cases_lie_in_their_intervals(sampler, split):
    learner = CalibratedLearner(Guesser(0.0), share=0.3)
    _, held_out = hold_out(sampler.cases, split, 0.3, 0)
    initial = np.random.default_rng(1).choice(split.train.initial, 400)
    pairs = np.stack([initial, np.resize(held_out, 400)], axis=1)
    assert 0.85 < coverage(learner.fit(sampler, split), sampler, pairs)["position"].share < 0.97


def test_an_answer_is_inside_where_its_activations_are_near_those_of_training(sampler, split):
    predictor = CalibratedLearner(Guesser(0.0)).fit(sampler, split)
    question = sampler.batch(split.test[:4]).question
    assert predictor.predict(question).inside.all()
    loaded = replace(question, hand_load=np.full(4, 30.0))
    assert not predictor.predict(loaded).inside.any()
    unknown = replace(question, activation=np.full_like(question.activation, np.nan))
    assert predictor.predict(unknown).inside.all()


def test_the_method_s_own_verdict_counts_too(sampler, split):
    predictor = CalibratedLearner(Guesser(0.0, inside=False)).fit(sampler, split)
    assert not predictor.predict(sampler.batch(split.test[:4]).question).inside.any()


def test_an_answer_from_sensors_is_inside_where_these_fit_a_known_shape(sensing, sampler, split):
    question = sampler.batch(split.test[:4]).question
    assert sensing.predict(question).inside.all()
    torn = question.sensor_target["position"] + np.random.default_rng(0).normal(scale=5, size=(4, 4, 3))
    odd = replace(question, sensor_target={**question.sensor_target, "position": torn})
    assert not sensing.predict(odd).inside.any()


def test_activations_that_a_method_does_not_read_do_not_judge_its_answer(sensing, sampler, split):
    question = sampler.batch(split.test[:4]).question
    assert sensing.predict(replace(question, hand_load=np.full(4, 30.0))).inside.all()


def test_a_calibrated_method_is_as_large_as_the_method(told_both):
    assert told_both.parameters == told_both.predictor.parameters > 0


def test_a_calibrated_method_is_named_as_the_method(sensing):
    assert sensing.name == CalibratedLearner(ModesLearner()).name == "neural_modes"
    assert "position" in sensing.fields


def test_coverage_and_widths_are_told_by_field(sensing, sampler, split):
    told = coverage(sensing, sampler, split.test[:100])
    assert set(told) == {"position", "von_mises"}
    assert all(0 <= field.share <= 1 and field.half_width > 0 for field in told.values())


def test_coverage_of_nothing_is_refused(sensing, sampler):
    with pytest.raises(InputError, match="at least one pair"):
        coverage(sensing, sampler, np.zeros((0, 2), dtype=np.int64))


def test_coverage_without_intervals_is_refused(sampler, split):
    with pytest.raises(InputError, match="calibrate it"):
        coverage(Guesser(0.0), sampler, split.test[:2])


def test_near_is_no_farther_than_training_cases_are_from_each_other(block_cases):
    line = replace(block_cases, activation=np.linspace(0, 1, len(block_cases))[:, None] * np.ones(5))
    found = nearness(line, np.arange(len(block_cases)))
    inner = np.full((1, 5), 0.5)
    assert found.near(inner, np.zeros(1)).all()
    assert not found.near(np.array([[0.5, 0.5, 0.5, 0.5, 0.9]]), np.zeros(1)).any()
    assert not found.near(inner, np.array([1.0])).any()
