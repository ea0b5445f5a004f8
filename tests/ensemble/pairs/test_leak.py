"""The leak check: what a protocol does not teach has no way into training."""

from dataclasses import fields, replace

import numpy as np
import pytest

from myograph.ensemble.pairs.hiding import seen_only
from myograph.ensemble.pairs.protocols import PROTOCOLS, split_pairs
from myograph.ensemble.pairs.question import CONVENTIONS, Question
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from tests.ensemble.pairs.made_up import NODES, made_up


def parts(batch):
    """Every array of a question and of its right answer, by name."""
    named = {part.name: getattr(batch.question, part.name) for part in fields(Question)} | {"truth": batch.truth}
    arrays = {}
    for name, value in named.items():
        inner = value.items() if isinstance(value, dict) else [("", value)]
        arrays |= {f"{name} {field}": array for field, array in inner if isinstance(array, np.ndarray)}
    return arrays


def assert_same(first, second):
    assert parts(first).keys() == parts(second).keys()
    for name, array in parts(first).items():
        assert array.tobytes() == parts(second)[name].tobytes(), name


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("support", [0, 4])
def test_training_does_not_change_when_all_that_it_must_not_see_is_no_number(protocol, convention, support):
    cases = made_up(10, 5, support)
    sampler = PairSampler(cases, random_sensors(NODES), convention, cases.fields, cases.fields)
    split = split_pairs(cases, protocol)
    poisoned = seen_only(cases, split.train.cases)
    again = split_pairs(poisoned, protocol)
    np.testing.assert_array_equal(split.train.all(), again.train.all())
    np.testing.assert_array_equal(split.test, again.test)
    assert_same(sampler.batch(split.train.all()), replace(sampler, cases=poisoned).batch(again.train.all()))


@pytest.mark.parametrize("protocol", ["strict", "off_grid"])
def test_training_does_not_change_when_the_tested_cases_change_places(protocol):
    cases = made_up(10, 5, 4)
    split = split_pairs(cases, protocol)
    tested = np.unique(split.test)
    swapped = np.arange(len(cases))
    swapped[tested] = np.roll(tested, 1)
    moved = replace(
        cases, activation=cases.activation[swapped], read=lambda name, chosen: cases.read(name, swapped[chosen])
    )
    sampler = PairSampler(cases, random_sensors(NODES), known=cases.fields, asked=cases.fields)
    other = replace(sampler, cases=moved)
    assert_same(sampler.batch(split.train.all()), other.batch(split_pairs(moved, protocol).train.all()))
    changed = parts(other.batch(split.test))["truth position"]
    assert (parts(sampler.batch(split.test))["truth position"] != changed).any()


@pytest.mark.parametrize("protocol", ["strict", "off_grid"])
def test_what_is_hidden_from_training_is_all_that_is_tested(protocol):
    """The check itself can fail: every number of the tests is poisoned, none of training is."""
    cases = made_up(10, 5, 4)
    split = split_pairs(cases, protocol)
    poisoned = seen_only(cases, split.train.cases)
    sampler = PairSampler(poisoned, random_sensors(NODES), known=cases.fields, asked=cases.fields)
    asked = sampler.batch(split.test)
    assert np.isnan(asked.question.activation).all()
    for values in (asked.truth, asked.question.sensor_target, asked.question.query_initial):
        assert all(np.isnan(array).all() for array in values.values())
    taught = parts(sampler.batch(split.train.all()))
    assert all(np.isfinite(array).all() for array in taught.values())


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_the_activations_of_strictly_tested_targets_are_those_of_no_training_case(protocol):
    cases = made_up(10, 5, 4)
    split = split_pairs(cases, protocol)
    taught = {tuple(row) for row in cases.activation[split.train.cases]}
    tested = {tuple(row) for row in cases.activation[split.test[:, 1]]}
    assert (tested <= taught) if protocol == "thesis" else not tested & taught


def test_hiding_leaves_the_cases_themselves_alone():
    cases = made_up()
    before = cases.values("position", np.arange(9)).copy()
    seen_only(cases, np.array([1])).values("position", np.arange(9))
    np.testing.assert_array_equal(cases.values("position", np.arange(9)), before)
    assert np.isfinite(cases.activation).all()
