"""What goes together, and what has to be solved again so that an answer depends on its chain alone."""

import numpy as np
import pytest

from myograph.case import Case
from myograph.ensemble.design import factorial_cases, off_grid_cases
from myograph.ensemble.running.chains import BATCH, CHAIN, Step, batches, steps

DONE, FAILED, MISSING = "done", "failed", None


def planned(states, remembers=True):
    return steps(range(len(states)), lambda case: states[case], remembers)


@pytest.mark.parametrize(("remembers", "size"), [(True, CHAIN), (False, BATCH)])
def test_every_case_is_in_one_batch(remembers, size):
    groups = batches(off_grid_cases(101, 1), remembers)
    assert sorted(case for group in groups for case in group) == list(range(101))
    assert max(map(len, groups)) == size


def test_neighbours_of_the_factorial_change_one_activation():
    cases = factorial_cases()
    for chain in batches(cases, True):
        walk = np.array([cases[case].activations for case in chain])
        assert (np.abs(np.diff(walk, axis=0)).sum(axis=1) <= 2).all()
        assert np.abs(np.diff(walk, axis=0)).sum() <= CHAIN + 1


def test_neighbours_count_loads_and_angles_by_their_ranges():
    cases = [Case((0.0,) * 5, load, angle) for load in (0.0, 100.0) for angle in (0.5, 1.0, 1.5)]
    walk = [case for chain in batches(cases, True) for case in chain]
    assert walk == [0, 1, 2, 5, 4, 3]


def test_without_memory_only_the_missing_are_solved():
    assert planned([DONE, MISSING, FAILED, MISSING], remembers=False) == [Step(1, True, False), Step(3, True, False)]


def test_a_whole_chain_is_solved_in_one_go():
    assert planned([MISSING] * 3) == [Step(0, True, True), Step(1, True, False), Step(2, True, False)]


def test_what_lies_before_a_missing_case_is_solved_again_and_not_stored():
    assert planned([DONE, DONE, MISSING, DONE]) == [Step(0, False, True), Step(1, False, False), Step(2, True, False)]


def test_after_a_failed_case_a_chain_begins_anew():
    assert planned([DONE, FAILED, DONE, MISSING]) == [Step(2, False, True), Step(3, True, False)]
    assert planned([MISSING, FAILED, DONE]) == [Step(0, True, True)]


def test_nothing_is_solved_where_nothing_is_missing():
    assert planned([DONE, FAILED, DONE]) == []
    assert planned([DONE, FAILED, DONE], remembers=False) == []
