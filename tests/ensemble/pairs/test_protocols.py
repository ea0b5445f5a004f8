"""The three protocols: what may be seen in training, and what is asked in the test."""

import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import PROTOCOLS, PairSet, check_protocol, split_pairs
from myograph.errors import InputError
from tests.ensemble.pairs.made_up import made_up


def pair_set(pairs):
    return {(int(i), int(j)) for i, j in pairs}


def thirty_two(off_grid=16, support=0):
    return made_up(32, off_grid, support)


@pytest.mark.parametrize("factorial", [6, 10, 32])
@pytest.mark.parametrize("support", [0, 5])
@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_no_tested_pair_is_ever_trained_on(protocol, factorial, support):
    split = split_pairs(made_up(factorial, 4, support), protocol)
    trained = split.train.all()
    assert len(pair_set(trained)) == len(trained) == len(split.train)
    assert len(pair_set(split.test)) == len(split.test) > 0
    assert not pair_set(trained) & pair_set(split.test)


@pytest.mark.parametrize("support", [0, 5])
def test_in_strict_no_tested_case_has_any_role_in_training(support):
    split = split_pairs(thirty_two(support=support), "strict")
    assert not set(split.train.cases) & set(split.test.ravel())


def test_in_thesis_no_tested_initial_case_is_an_initial_case_of_training_but_all_targets_are_seen():
    split = split_pairs(thirty_two(), "thesis")
    assert not set(split.train.initial) & set(split.test[:, 0])
    assert set(split.train.target) == set(split.test[:, 1]) == set(range(16, 48))


@pytest.mark.parametrize("support", [0, 5])
def test_in_off_grid_no_tested_case_has_any_role_in_training(support):
    split = split_pairs(thirty_two(support=support), "off_grid")
    assert set(split.test.ravel()) == set(range(16))
    assert not set(split.train.cases) & set(range(16))


def test_in_off_grid_without_support_training_is_that_of_thesis():
    off_grid, thesis = (split_pairs(thirty_two(), protocol).train for protocol in ("off_grid", "thesis"))
    np.testing.assert_array_equal(off_grid.all(), thesis.all())


def test_support_cases_teach_in_both_roles_of_strict_and_off_grid_and_never_in_thesis():
    support = set(range(48, 53))
    for protocol in PROTOCOLS:
        split = split_pairs(thirty_two(support=5), protocol)
        expected = set() if protocol == "thesis" else support
        assert set(split.train.initial) & support == set(split.train.target) & support == expected
        assert not set(split.test.ravel()) & support


@pytest.mark.parametrize(
    ("protocol", "train", "test"),
    [("thesis", 25 * 32, 7 * 32), ("strict", 25 * 25, 7 * 6), ("off_grid", 25 * 32, 16 * 15)],
)
def test_thirty_two_cases_split_into_25_and_7(protocol, train, test):
    split = split_pairs(thirty_two(), protocol)
    assert (len(split.train), len(split.test)) == (train, test)


@pytest.mark.parametrize("protocol", ["strict", "off_grid"])
def test_nothing_is_asked_about_a_case_and_itself(protocol):
    test = split_pairs(thirty_two(), protocol).test
    assert (test[:, 0] != test[:, 1]).all()


def test_the_seed_decides_who_is_held_out():
    first, again, other = (split_pairs(thirty_two(), "strict", seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.test, again.test)
    assert set(first.test.ravel()) != set(other.test.ravel())


def test_thesis_and_strict_hold_out_the_same_cases():
    thesis, strict = (split_pairs(thirty_two(), protocol) for protocol in ("thesis", "strict"))
    assert set(thesis.test[:, 0]) == set(strict.test[:, 0])


def test_pairs_are_drawn_from_all_pairs_and_follow_the_generator():
    pairs = PairSet(np.array([4, 7]), np.array([1, 2, 7]))
    drawn = pairs.draw(np.random.default_rng(0), 200)
    np.testing.assert_array_equal(drawn, pairs.draw(np.random.default_rng(0), 200))
    assert pair_set(drawn) == pair_set(pairs.all()) == {(i, j) for i in (4, 7) for j in (1, 2, 7)}
    assert pairs.cases.tolist() == [1, 2, 4, 7]


@pytest.mark.parametrize(
    ("counts", "protocol", "message"),
    [
        ((5, 16), "strict", "at least 6 cases of design 'factorial', got 5"),
        ((0, 16), "thesis", "at least 6 cases of design 'factorial', got 0"),
        ((32, 1), "off_grid", "at least 2 cases of design 'off_grid', got 1"),
    ],
)
def test_data_without_the_cases_of_a_protocol_are_an_input_error(counts, protocol, message):
    with pytest.raises(InputError, match=message):
        split_pairs(made_up(*counts), protocol)


def test_an_unknown_protocol_is_an_input_error():
    with pytest.raises(InputError, match="unknown protocol 'easy': expected one of thesis, strict, off_grid"):
        check_protocol("easy")
