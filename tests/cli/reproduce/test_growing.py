"""Which cases come next: the least certain one, or the one that makes the others more certain."""

import numpy as np
import pytest

from myograph.cli.reproduce.growing import FIRST, grown, next_cases
from myograph.cli.reproduce.trial import Chosen, Drawn
from myograph.cli.reproduce.trying import cases_of

CLUSTER = np.array([[1.0, 0.9, 0.9, 0.0], [0.9, 1.0, 0.9, 0.0], [0.9, 0.9, 1.0, 0.0], [0.0, 0.0, 0.0, 1.2]])


@pytest.fixture
def pool(data, store):
    cases = Chosen("ensemble", data.numbers("ensemble", "support"), data.numbers("ensemble", "off_grid"))
    return cases_of(cases, {"ensemble": store})


@pytest.mark.parametrize(("by", "first"), [("deviation", 3), ("overall", 0)])
def test_the_largest_deviation_is_alone_and_the_most_telling_case_has_neighbours(by, first):
    assert next_cases(CLUSTER, 1e-6, [], (1, by)) == [first]


@pytest.mark.parametrize("by", ["deviation", "overall"])
def test_a_twin_of_a_known_case_comes_last(by):
    assert next_cases(CLUSTER, 1e-6, [0], (2, by)) == [0, 3]
    assert sorted(next_cases(CLUSTER, 1e-6, [0], (4, by))) == [0, 1, 2, 3]


def test_noise_keeps_a_known_case_from_saying_all_of_its_twin():
    assert next_cases(np.array([[1.0, 0.99, 0.0], [0.99, 1.0, 0.0], [0.0, 0.0, 0.1]]), 10.0, [0], (2, "deviation")) == [
        0, 1,
    ]  # fmt: skip


def test_cases_are_all_of_them_where_nothing_is_drawn(pool):
    assert grown(pool, None, 0) is pool


@pytest.mark.parametrize("by", ["random", "deviation", "overall"])
def test_as_many_cases_as_are_drawn_beginning_with_the_same_random_ones(pool, by):
    inside = len(pool.named("off_grid"))
    found = {count: grown(pool, Drawn(count, by), seed=1) for count in (FIRST, 12, 20)}
    assert {count: len(cases) - inside for count, cases in found.items()} == {FIRST: FIRST, 12: 12, 20: 20}
    rows = {count: {tuple(row) for row in cases.activation[:-inside].tolist()} for count, cases in found.items()}
    assert rows[FIRST] < rows[12] < rows[20]
    first = grown(pool, Drawn(FIRST, "random"), seed=1)
    assert np.array_equal(found[FIRST].activation, first.activation)
    assert not np.array_equal(grown(pool, Drawn(FIRST, by), seed=2).activation, first.activation)
