"""Views of cases: the same numbers under other words, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.views import chosen, joined
from myograph.errors import InputError
from tests.ensemble.pairs.made_up import made_up


def test_chosen_cases_are_those_of_the_numbers_under_their_words():
    cases = made_up()
    some = chosen(cases, {"factorial": [5, 2], "off_grid": [7]})
    assert some.design == ("factorial", "factorial", "off_grid")
    np.testing.assert_array_equal(some.activation, cases.activation[[5, 2, 7]])
    there = some.values("position", np.array([2, 0]))
    np.testing.assert_array_equal(there, cases.values("position", np.array([7, 5])))
    assert some.checksum != cases.checksum
    assert some.checksum == chosen(cases, {"factorial": [5, 2], "off_grid": [7]}).checksum
    assert some.checksum != chosen(cases, {"factorial": [5], "off_grid": [2, 7]}).checksum


@pytest.mark.parametrize(("words", "message"), [({"a": [1], "b": [1]}, "every case once"), ({"a": [-1]}, "from 0 to")])
def test_a_case_that_is_none_or_comes_twice_is_refused(words, message):
    with pytest.raises(InputError, match=message):
        chosen(made_up(), words)


def test_joined_cases_are_both_in_order():
    cases = made_up()
    first, second = chosen(cases, {"a": [0, 1]}), chosen(cases, {"b": [3]})
    both = joined(first, second)
    assert both.design == ("a", "a", "b")
    there = both.values("position", np.array([2, 0, 1]))
    np.testing.assert_array_equal(there, cases.values("position", np.array([3, 0, 1])))
    assert both.checksum not in (first.checksum, second.checksum)


def test_cases_of_another_body_are_not_joined():
    cases = made_up()
    other = replace(cases, body=replace(cases.body, reference=cases.body.reference + 1.0))
    with pytest.raises(InputError, match="expected one body"):
        joined(cases, other)
