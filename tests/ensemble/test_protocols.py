"""The three protocols: what may be seen in training, and what is asked in the test."""

import numpy as np
import pytest
import xarray as xr

from myograph.ensemble.protocols import PROTOCOLS, split_pairs
from myograph.errors import InputError


def cases(factorial=32, off_grid=16):
    return xr.Dataset({"design": ("cases", np.array(["off_grid"] * off_grid + ["factorial"] * factorial))})


def pair_set(pairs):
    return {(int(i), int(j)) for i, j in pairs}


@pytest.mark.parametrize("factorial", [6, 10, 32, 243])
@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_no_tested_pair_is_ever_trained_on(protocol, factorial):
    split = split_pairs(cases(factorial), protocol)
    assert len(pair_set(split.train)) == len(split.train)
    assert len(pair_set(split.test)) == len(split.test) > 0
    assert not pair_set(split.train) & pair_set(split.test)


def test_in_strict_no_tested_case_has_any_role_in_training():
    split = split_pairs(cases(), "strict")
    assert not set(split.train.ravel()) & set(split.test.ravel())


def test_in_thesis_no_tested_initial_case_is_an_initial_case_of_training_but_all_targets_are_seen():
    split = split_pairs(cases(), "thesis")
    assert not set(split.train[:, 0]) & set(split.test[:, 0])
    assert set(split.train[:, 1]) == set(split.test[:, 1]) == set(range(16, 48))


def test_in_off_grid_training_is_that_of_thesis_and_no_tested_case_has_any_role_in_it():
    split = split_pairs(cases(), "off_grid")
    np.testing.assert_array_equal(split.train, split_pairs(cases(), "thesis").train)
    assert set(split.test.ravel()) == set(range(16))


@pytest.mark.parametrize(
    ("protocol", "train", "test"),
    [("thesis", 25 * 32, 7 * 32), ("strict", 25 * 25, 7 * 6), ("off_grid", 25 * 32, 16 * 15)],
)
def test_thirty_two_cases_split_into_25_and_7(protocol, train, test):
    split = split_pairs(cases(), protocol)
    assert (len(split.train), len(split.test)) == (train, test)


@pytest.mark.parametrize("protocol", ["strict", "off_grid"])
def test_nothing_is_asked_about_a_case_and_itself(protocol):
    test = split_pairs(cases(), protocol).test
    assert (test[:, 0] != test[:, 1]).all()


def test_the_seed_decides_who_is_held_out():
    first, again, other = (split_pairs(cases(), "strict", seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.test, again.test)
    assert set(first.test.ravel()) != set(other.test.ravel())


def test_thesis_and_strict_hold_out_the_same_cases():
    thesis, strict = (split_pairs(cases(), protocol) for protocol in ("thesis", "strict"))
    assert set(thesis.test[:, 0]) == set(strict.test[:, 0])


@pytest.mark.parametrize(
    ("dataset", "protocol", "message"),
    [
        (cases(factorial=5), "strict", "at least 6 cases of design 'factorial', got 5"),
        (cases(factorial=0), "thesis", "at least 6 cases of design 'factorial', got 0"),
        (cases(off_grid=1), "off_grid", "at least 2 cases of design 'off_grid', got 1"),
    ],
)
def test_a_dataset_without_the_cases_of_a_protocol_is_an_input_error(dataset, protocol, message):
    with pytest.raises(InputError, match=message):
        split_pairs(dataset, protocol)
