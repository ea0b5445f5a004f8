"""Courses of the rates."""

import pytest

from myograph.learning.training.schedule import RISE, rate_at


def test_one_cycle_rises_in_a_line_and_falls_to_nothing():
    assert rate_at("one_cycle", RISE / 2) == pytest.approx(0.5)
    assert rate_at("one_cycle", RISE) == pytest.approx(1)
    assert rate_at("one_cycle", (1 + RISE) / 2) == pytest.approx(0.5)
    assert rate_at("one_cycle", 1.0) == rate_at("one_cycle", 1.5) == pytest.approx(0)


def test_a_cosine_falls_from_the_start():
    assert [rate_at("cosine", share) for share in (0, 0.5, 1)] == pytest.approx([1, 0.5, 0])


def test_a_constant_rate_stays():
    assert [rate_at("constant", share) for share in (0, 0.5, 1)] == [1, 1, 1]
