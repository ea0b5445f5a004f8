"""Questions about pairs: what sensors tell, what is asked, what is right."""

from dataclasses import fields, replace

import numpy as np
import pytest

from myograph.ensemble.pairs.question import Question, check_convention
from myograph.ensemble.pairs.sampler import PairSampler, listed_sensors, random_sensors
from myograph.errors import InputError
from tests.ensemble.pairs.made_up import NODES, made_up

PAIRS = np.array([[0, 3], [2, 2], [3, 1]])
INITIAL, TARGET = PAIRS.T
EVERY = np.arange(9)


@pytest.fixture
def cases():
    return made_up()


@pytest.fixture
def sampler(cases):
    return PairSampler(cases, random_sensors(NODES))


def test_sensors_tell_where_they_are_in_the_initial_and_in_the_target_case(cases, sampler):
    question = sampler.batch(PAIRS).question
    position = cases.values("position", EVERY)
    np.testing.assert_array_equal(question.sensor_initial["position"], position[INITIAL][:, sampler.sensors])
    np.testing.assert_array_equal(question.sensor_target["position"], position[TARGET][:, sampler.sensors])
    np.testing.assert_array_equal(question.sensor_nodes, sampler.sensors)
    assert question.size == 3


def test_queries_are_known_in_the_initial_case_and_answered_in_the_target_case(cases, sampler):
    batch = sampler.batch(PAIRS)
    position = cases.values("position", EVERY)
    np.testing.assert_array_equal(batch.question.query_initial["position"], position[INITIAL][:, sampler.queries])
    np.testing.assert_array_equal(batch.truth["position"], position[TARGET][:, sampler.queries])
    np.testing.assert_array_equal(batch.question.query_nodes, sampler.queries)


def test_activation_and_load_are_those_of_the_target_case(cases, sampler):
    loaded = replace(cases, hand_load=np.arange(9.0))
    question = replace(sampler, cases=loaded).batch(PAIRS).question
    np.testing.assert_array_equal(question.activation, cases.activation[TARGET])
    np.testing.assert_array_equal(question.hand_load, TARGET)


def test_in_the_convention_initial_points_are_named_by_where_they_are_in_the_initial_case(sampler):
    question = sampler.batch(PAIRS).question
    np.testing.assert_array_equal(question.sensor_places, question.sensor_initial["position"])
    np.testing.assert_array_equal(question.query_places, question.query_initial["position"])


def test_in_the_convention_material_points_have_one_name_in_all_cases(cases):
    sampler = PairSampler(cases, random_sensors(NODES), "material")
    question = sampler.batch(PAIRS).question
    for places, nodes in ((question.sensor_places, sampler.sensors), (question.query_places, sampler.queries)):
        np.testing.assert_array_equal(places, np.tile(cases.body.reference[nodes], (3, 1, 1)))


def test_any_fields_are_told_and_any_are_asked(cases):
    sampler = PairSampler(cases, random_sensors(NODES), known=("cauchy_stress",), asked=("von_mises",))
    batch = sampler.batch(PAIRS)
    assert set(batch.question.sensor_initial) == set(batch.question.sensor_target) == {"position", "cauchy_stress"}
    assert set(batch.question.query_initial) == {"position", "von_mises"}
    assert set(batch.truth) == {"von_mises"}
    stress = cases.values("cauchy_stress", TARGET)[:, sampler.sensors]
    np.testing.assert_array_equal(batch.question.sensor_target["cauchy_stress"], stress)


def test_only_the_named_queries_are_asked(sampler):
    some = sampler.batch(PAIRS, sampler.queries[[4, 1]])
    np.testing.assert_array_equal(some.truth["position"], sampler.batch(PAIRS).truth["position"][:, [4, 1]])
    np.testing.assert_array_equal(some.question.query_places, sampler.batch(PAIRS).question.query_places[:, [4, 1]])


def test_batches_are_all_pairs_in_their_order(sampler):
    pairs = np.stack(np.divmod(np.arange(7), 3), axis=1)
    sizes = [batch.question.size for batch in sampler.batches(pairs, 3)]
    truth = np.concatenate([batch.truth["position"] for batch in sampler.batches(pairs, 3)])
    assert sizes == [3, 3, 1]
    np.testing.assert_array_equal(truth, sampler.batch(pairs).truth["position"])


def test_every_node_is_a_sensor_or_a_query_and_none_is_both(cases):
    sampler = PairSampler(cases, random_sensors(NODES, 5))
    assert len(sampler.sensors) == 5
    assert sorted([*sampler.sensors, *sampler.queries]) == list(range(NODES))


def test_the_seed_decides_which_nodes_are_sensors():
    first, again, other = (random_sensors(NODES, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert set(first) != set(other)
    assert len(first) == 9


def test_a_question_holds_nothing_of_the_target_case_at_the_queries(cases):
    """Each number of the target cases at the queries is looked for in all that the question says."""
    sampler = PairSampler(cases, random_sensors(NODES), known=cases.fields, asked=cases.fields)
    batch = sampler.batch(np.array([[0, 3], [2, 1]]))
    told = _numbers(*(getattr(batch.question, part.name) for part in fields(Question)))
    assert np.isin(_numbers(batch.question.sensor_target), told).all()
    assert not np.isin(_numbers(batch.truth), told).any()


def _numbers(*parts):
    """All numbers of arrays, and of arrays by name."""
    arrays = [array for part in parts for array in (part.values() if isinstance(part, dict) else [part])]
    return np.concatenate([np.ravel(array) for array in arrays if isinstance(array, np.ndarray)])


@pytest.mark.parametrize("count", [0, NODES])
def test_a_number_of_sensors_that_leaves_nothing_to_know_or_to_ask_is_an_input_error(count):
    with pytest.raises(InputError, match=f"between 1 and 19 sensors on 20 nodes, got {count}"):
        random_sensors(NODES, count)


def test_listed_sensors_are_taken_in_their_order():
    assert listed_sensors([7, 0, 19], NODES).tolist() == [7, 0, 19]


@pytest.mark.parametrize(
    ("listed", "words"),
    [
        ([], "1 to 19 of the nodes 0 to 19, got none"),
        ([3, 20], r"1 to 19 of the nodes 0 to 19, got \[3, 20\]"),
        ([-1, 3], "1 to 19 of the nodes"),
        (list(range(NODES)), "1 to 19 of the nodes"),
        ([3, 5, 3], r"every node once, got \[3, 5, 3\]"),
    ],
)
def test_sensors_that_are_no_nodes_or_doubled_are_input_errors(cases, listed, words):
    with pytest.raises(InputError, match=words):
        listed_sensors(listed, NODES)
    with pytest.raises(InputError, match=words):
        PairSampler(cases, np.array(listed, dtype=np.int64))


def test_unknown_conventions_and_fields_are_input_errors(cases):
    with pytest.raises(InputError, match="convention: expected one of initial, material, got 'final'"):
        check_convention("final")
    for words in ({"known": ("pressure",)}, {"asked": ("position", "pressure")}):
        with pytest.raises(InputError, match="expected one of the fields position, cauchy_stress, von_mises, got 'pre"):
            PairSampler(cases, np.array([1, 2]), **words)
