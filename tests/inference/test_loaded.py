"""Answers of saved models: closed forms, verdicts, intervals, and mistakes."""

from dataclasses import replace

import numpy as np
import pytest

import myograph
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError, NotConvergedError
from myograph.inference.session import run_session
from myograph.inference.ways import NORMAL_90
from tests.inference.stand_in import SENSORS, place, stand_in_cases

ROUNDING = 1e-4  # mm: single precision of 100 mm


def test_two_lines_give_the_closed_form_at_all_nodes(saved):
    answer = myograph.load(saved / "linear").predict_activation([0.3, 0.7, 0.5, 0, 0.2])
    expected = place(np.array([[0.3, 0.7, 0.5, 0, 0.2]]))
    np.testing.assert_allclose(answer.values["position"], expected, atol=ROUNDING)


def test_activations_by_name_by_row_and_in_order_are_the_same(linear):
    names = dict(zip(myograph.MUSCLES, (0.1, 0.2, 0.3, 0.4, 0.5), strict=True))
    answers = [linear.predict_activation(asked) for asked in (names, list(names.values()), [list(names.values())])]
    for answer in answers[1:]:
        np.testing.assert_array_equal(answer.values["position"], answers[0].values["position"])


def test_many_cases_are_answered_as_one_by_one(linear):
    activation = np.random.default_rng(0).uniform(size=(40, 5))
    together = linear.predict_activation(activation).values["position"]
    alone = np.concatenate([linear.predict_activation(row).values["position"] for row in activation])
    np.testing.assert_allclose(together, alone, atol=ROUNDING)


def test_asked_nodes_are_those_of_all(linear):
    everywhere = linear.predict_activation([0, 0, 1, 0, 0]).values["von_mises"]
    some = linear.predict_activation([0, 0, 1, 0, 0], queries=[5, 3]).values["von_mises"]
    np.testing.assert_array_equal(some, everywhere[:, [5, 3]])


def test_a_model_is_a_predictor_of_pairs(linear):
    cases = stand_in_cases()
    batch = PairSampler(cases, np.array(SENSORS), "material").batch(np.array([[0, 5], [9, 35]]))
    assert isinstance(linear, Predictor)
    assert linear.fields == ("position", "von_mises")
    answer = linear.predict(batch.question)
    np.testing.assert_allclose(answer.values["position"], batch.truth["position"], atol=ROUNDING)


def test_a_translation_of_the_sensors_translates_every_node(mean):
    rest = mean.body.rest["position"]
    nodes, way = [4, 30, 22], np.array([3.0, -2.0, 1.0])
    answer = mean.predict_sensors(nodes, rest[nodes] + way)
    np.testing.assert_allclose(answer.values["position"][0], rest + way, atol=ROUNDING)
    np.testing.assert_allclose(answer.deviation["position"], 0, atol=ROUNDING)


def test_sensors_by_place_are_those_at_the_nodes(mean):
    nodes, now = [4, 30, 22], mean.body.rest["position"][[4, 30, 22]] + 1.0
    by_place = mean.predict_sensors(mean.body.body.reference[nodes] + 0.4, now)
    by_node = mean.predict_sensors(nodes, now)
    np.testing.assert_array_equal(by_place.values["position"], by_node.values["position"])


def pulled_apart(model, nodes, by=6.0):
    """Positions at which the last of the sensors is that far from the others [mm]."""
    now = model.body.rest["position"][list(nodes)].astype(float)
    now[-1, 0] += by
    return now


def test_half_widths_are_the_calibrated_scale_times_the_deviation(mean):
    answer = mean.predict_sensors(SENSORS, pulled_apart(mean, SENSORS))
    np.testing.assert_allclose(answer.deviation["position"], 4.5, atol=ROUNDING)
    np.testing.assert_allclose(answer.half_width_90["position"], 1.5 * 4.5, atol=ROUNDING)


def test_other_sensors_than_those_that_calibrated_have_the_half_widths_of_a_normal_distribution(mean):
    answer = mean.predict_sensors([4, 30], pulled_apart(mean, [4, 30]))
    np.testing.assert_allclose(answer.deviation["position"], 3.0, atol=ROUNDING)
    np.testing.assert_allclose(answer.half_width_90["position"], NORMAL_90 * 3.0, atol=ROUNDING)
    wide = replace(mean, told=mean.told.model_copy(update={"half_width_90": {"position": 2.0}}))
    answer = wide.predict_sensors([4, 30], pulled_apart(mean, [4, 30]))
    np.testing.assert_allclose(answer.half_width_90["position"], 2.0 * 3.0, atol=ROUNDING)


@pytest.mark.parametrize(("noise", "times"), [(0.0, 1.5), (0.1, NORMAL_90), (0.2, NORMAL_90), (0.6, 3 * NORMAL_90)])
def test_half_widths_grow_with_the_noise_of_the_sensors_beyond_what_deviations_are_made_for(mean, noise, times):
    noisy = _known(mean, sensor_noise=0.2)
    answer = noisy.predict_sensors(SENSORS, pulled_apart(mean, SENSORS), sensor_noise=noise)
    np.testing.assert_allclose(answer.half_width_90["position"], times * 4.5, atol=ROUNDING)


def test_a_model_that_knows_no_noise_has_no_intervals_for_it(mean):
    answer = mean.predict_sensors(SENSORS, pulled_apart(mean, SENSORS), sensor_noise=0.1)
    assert answer.half_width_90 == {}


def test_noise_explains_some_of_the_residual(mean):
    """Of two sensors, one may be 8.5 mm from their mean where 8 mm are allowed and noise makes up for the rest."""
    now = pulled_apart(mean, [4, 30], 17.0)
    allowed = replace(mean, body=replace(mean.body, low=mean.body.low - 20, high=mean.body.high + 20))
    assert allowed.predict_sensors([4, 30], now).inside.tolist() == [False]
    needed = np.sqrt(8.5**2 - 8.0**2) / np.sqrt(16.8119 / 2)  # 99 % of chi-square with six degrees of freedom
    for noise, inside in ((0.99 * needed, False), (1.01 * needed, True)):
        assert allowed.predict_sensors([4, 30], now, sensor_noise=noise).inside.tolist() == [inside]


def test_a_model_without_residual_is_outside_with_other_sensors_and_has_no_intervals_there(mean):
    silent = _known(mean, outputs=("position",))
    rest = mean.body.rest["position"]
    usual = silent.predict_sensors(SENSORS, rest[list(SENSORS)])
    assert usual.inside.tolist() == [True]
    assert set(usual.half_width_90) == {"position"}
    other = silent.predict_sensors([4, 30], rest[[4, 30]])
    assert other.inside.tolist() == [False]
    assert other.half_width_90 == {}


@pytest.mark.parametrize("noise", [-0.1, np.nan, np.inf])
def test_noise_that_cannot_be_is_refused(mean, noise):
    with pytest.raises(InputError, match="expected a standard deviation in mm"):
        mean.predict_sensors([4, 30], mean.body.rest["position"][[4, 30]], sensor_noise=noise)


def test_activations_by_name_may_be_one_for_each_case(linear):
    by_name = dict.fromkeys(myograph.MUSCLES, 0.0) | {"brachialis": 0.3, "biceps": [0.1, 0.9], "triceps": (0, 1)}
    rows = [[0, 0.3, 0.1, 0, 0], [0, 0.3, 0.9, 0, 1]]
    found, wanted = (linear.predict_activation(asked).values["position"] for asked in (by_name, rows))
    np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("position", "error", "message"),
    [
        (np.zeros((1, 5)), InputError, r"position of shape \(1, 5\) and float64, expected \(1, 40, 3\)"),
        (np.zeros((1, 1, 3)), InputError, "expected"),
        (np.zeros((1, 40, 3), dtype=int), InputError, "int64"),
        (np.full((1, 40, 3), np.nan), NotConvergedError, "position that is not finite"),
    ],
)
def test_what_a_network_gives_is_checked(linear, monkeypatch, position, error, message):
    given = {"position": position, "von_mises": np.zeros((1, 40))}
    monkeypatch.setattr("myograph.inference.loaded.run_session", lambda *_: given)
    with pytest.raises(error, match=message):
        linear.predict_activation([0] * 5)


@pytest.mark.parametrize(
    ("activation", "load", "inside"),
    [
        ((1, 1, 1, 1, 0.5), 20.0, True),
        ((0, 0, 0, 0, 0.51), 0.0, False),
        ((0, 0, 0, 0, 0), 20.1, False),
        ((0, 0, 0, 0, 0), -0.1, False),
    ],
)
def test_activations_and_loads_beyond_training_are_outside(linear, activation, load, inside):
    assert linear.predict_activation(activation, load).inside.tolist() == [inside]


def test_each_case_has_its_own_load(linear):
    assert linear.predict_activation(np.zeros((2, 5)), np.array([0.0, 30.0])).inside.tolist() == [True, False]


def test_sensors_that_contradict_each_other_are_outside(mean):
    rest = mean.body.rest["position"][[4, 30]]
    assert mean.predict_sensors([4, 30], rest).inside.tolist() == [True]
    apart = rest + np.array([[0.0, 9.0, 0.0], [0.0, -8.0, 0.0]])  # 8.5 mm from their mean, 8 are allowed
    assert mean.predict_sensors([4, 30], apart).inside.tolist() == [False]


def test_sensors_that_left_their_box_of_training_are_outside(mean):
    low, high = mean.body.low[[4, 30]], mean.body.high[[4, 30]]
    length = np.linalg.norm(np.ptp(mean.body.rest["position"], axis=0))
    reach = 0.1 * np.linalg.norm(high - low, axis=1) + 1e-3 * length
    corner = np.array([[0.0, 0.0, 1.0]] * 2)
    within, beyond = high + 0.9 * reach.min() * corner, high + 1.1 * reach.max() * corner
    lenient = replace(mean, told=mean.told.model_copy(update={"trained_range": _any_residual(mean)}))
    assert lenient.predict_sensors([4, 30], within).inside.tolist() == [True]
    assert lenient.predict_sensors([4, 30], beyond).inside.tolist() == [False]


def test_a_sensor_on_a_clamped_node_may_be_off_a_little(mean):
    still = replace(mean.body, low=mean.body.rest["position"], high=mean.body.rest["position"])
    lenient = replace(mean, body=still, told=mean.told.model_copy(update={"trained_range": _any_residual(mean)}))
    length = np.linalg.norm(np.ptp(still.rest["position"], axis=0))
    rest, along = still.rest["position"][[4, 30]], np.array([0.0, 0.0, length])
    assert lenient.predict_sensors([4, 30], rest + 9e-4 * along).inside.tolist() == [True]
    assert lenient.predict_sensors([4, 30], rest + 1.1e-3 * along).inside.tolist() == [False]


def _any_residual(model):
    return model.told.trained_range.model_copy(update={"residual_mm": None})


@pytest.mark.parametrize(
    ("activation", "load", "queries", "message"),
    [
        ([0, 0, 0, 0], 0, None, "expected 5 activations"),
        ([0, 0, 1.2, 0, 0], 0, None, r"biceps: expected a number in \[0, 1\], got 1.2"),
        ([0, 0, float("nan"), 0, 0], 0, None, "biceps: expected a number"),
        (["a"] * 5, 0, None, "expected numbers"),
        (np.zeros((1, 1, 5)), 0, None, "expected rows of 5"),
        (np.zeros((0, 5)), 0, None, "expected rows of 5"),
        ({"bicep": 1.0}, 0, None, "unknown muscle 'bicep'"),
        ({"biceps": 1.0}, 0, None, "got none of brachioradialis"),
        ([0] * 5, float("inf"), None, "expected newtons"),
        ([0] * 5, np.zeros(3), None, "expected newtons"),
        ([0] * 5, 0, [40], "expected nodes from 0 to 39"),
        ([0] * 5, 0, [], "expected nodes from 0 to 39"),
    ],
)
def test_activations_that_cannot_be_are_refused(linear, activation, load, queries, message):
    with pytest.raises(InputError, match=message):
        linear.predict_activation(activation, load, queries)


@pytest.mark.parametrize(
    ("sensors", "change", "message"),
    [
        ([4, 4], 0, "expected every node once"),
        ([4], 0, "expected at least 2 sensors"),
        ([4, 40], 0, "expected nodes from 0 to 39"),
        ([], 0, "expected node numbers or places"),
        ([0.5, 1.5], 0, "expected node numbers or places"),
        ([[0.0, 0.0, 0.0], [0.0, 0.0, 16.0]], 0, "outside it"),
        ([[0.0, 0.0, 0.0], [0.0, np.nan, 6.0]], 0, "finite places"),
        ([4, 30], np.nan, "expected finite numbers of mm"),
        ([4, 30], 1e4, "are these mm, in the arm's frame"),
        ([4, 30, 5], 0, r"expected 3 sensors of three coordinates, got shape \(1, 2, 3\)"),
    ],
)
def test_sensors_that_cannot_be_are_refused(mean, sensors, change, message):
    positions = np.zeros((min(len(sensors), 2), 3)) + change
    with pytest.raises(InputError, match=message):
        mean.predict_sensors(sensors, positions)


def test_a_model_is_asked_only_what_it_answers(linear, mean):
    with pytest.raises(InputError, match="answers from activations"):
        linear.predict_sensors([1, 2], np.zeros((2, 3)))
    with pytest.raises(InputError, match="answers from sensors; expected them"):
        mean.predict_activation([0] * 5)
    with pytest.raises(InputError, match="answers from sensors alone"):
        mean.predict_sensors([4, 30], mean.body.rest["position"][[4, 30]], activation=[0] * 5)


def _known(model, **other):
    """The model as if it had told other things of itself."""
    signature = model.told.signature.model_copy(update=other)
    return replace(model, told=model.told.model_copy(update={"signature": signature}))


def test_fixed_sensors_are_put_in_the_order_of_the_training(mean):
    fixed = _known(mean, any_sensors=False)
    rest = mean.body.rest["position"]
    order = [27, 0, 39, 13]
    answer = fixed.predict_sensors(order, rest[order] + 2.0)
    np.testing.assert_allclose(answer.values["position"][0], rest + 2.0, atol=ROUNDING)


def test_other_sensors_than_the_trained_are_refused_where_these_are_fixed(mean):
    fixed = _known(mean, any_sensors=False)
    with pytest.raises(InputError, match=r"expected the 4 sensors of the training, at the nodes \[0, 13, 27, 39\]"):
        fixed.predict_sensors([4, 30], mean.body.rest["position"][[4, 30]])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"convention": "initial"}, "convention 'material', got 'initial'"),
        ({"query_places": np.full((1, 2, 3), np.nan)}, "query_places: expected finite numbers"),
        ({"activation": np.zeros((1, 4))}, "activation: expected 5"),
        ({"activation": np.full((1, 5), np.nan)}, "expected a number in"),
    ],
)
def test_questions_that_cannot_be_are_refused(linear, change, message):
    cases = stand_in_cases()
    question = PairSampler(cases, np.array(SENSORS), "material").batch(np.array([[0, 5]]), np.array([1, 2])).question
    with pytest.raises(InputError, match=message):
        linear.predict(replace(question, **change))


def test_what_a_network_cannot_take_is_the_callers_mistake(linear):
    given = {"activation": np.zeros((3, 5), np.float32), "query_places": np.zeros((2, 4, 3), np.float32)}
    with pytest.raises(InputError, match="does not take inputs of the shapes"):
        run_session(linear.session, given, ("position",))


def test_unknown_activations_are_answered_by_models_that_can(linear):
    cases = stand_in_cases()
    question = PairSampler(cases, np.array(SENSORS), "material").batch(np.array([[0, 5]])).question
    unknown = replace(question, activation=np.full((1, 5), np.nan))
    assert _known(linear, unknown_activation=True).predict(unknown).inside.tolist() == [True]


def test_the_load_of_cases_whose_activations_are_unknown_is_not_judged(linear):
    """What is told by sensors alone has no activations and no load: neither can be outside."""
    cases = stand_in_cases()
    question = PairSampler(cases, np.array(SENSORS), "material").batch(np.array([[0, 2], [0, 2]])).question
    activation = question.activation.copy()
    activation[0] = np.nan
    asked = replace(question, activation=activation, hand_load=np.full(2, 30.0))
    assert _known(linear, unknown_activation=True).predict(asked).inside.tolist() == [True, False]


def test_sensors_at_the_same_place_are_refused(mean):
    cases = stand_in_cases()
    question = PairSampler(cases, np.array([4, 30])).batch(np.array([[0, 5]])).question
    with pytest.raises(InputError, match="pair 0: expected 2 sensors at different places, got 1"):
        mean.predict(replace(question, sensor_places=np.zeros((1, 2, 3))))
