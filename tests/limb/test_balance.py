"""Roots of a balance of moments: all of them, also where it only touches zero or is zero at an end."""

import numpy as np
import pytest

from myograph.limb.equilibrium import SCAN, equilibria


def _found(balance, low=0.0, high=2.0):
    return [(e.angle, e.stable) for e in equilibria(balance, low, high)]


def test_all_roots_of_a_cubic_are_found_with_their_stability():
    found = _found(lambda t: -(t - 0.503) * (t - 1.007) * (t - 1.71))
    assert found == [(pytest.approx(root, abs=1e-10), stable) for root, stable in ((0.503, 1), (1.007, 0), (1.71, 1))]


@pytest.mark.parametrize("root", [0.7777, 1.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_double_root_is_found_once_and_is_not_stable(root, sign):
    """At a scanned angle (1.0) and between two."""
    assert _found(lambda t: sign * (t - root) ** 2) == [(pytest.approx(root, abs=1e-6), False)]


@pytest.mark.parametrize("sign", [1, -1])
def test_two_roots_nearer_than_a_step_of_the_scan_are_both_found(sign):
    step = 2.0 / (SCAN - 1)
    first, second = 0.7 + 0.3 * step, 0.7 + 0.6 * step
    found = _found(lambda t: sign * (t - first) * (t - second) * (1 + t))
    assert found == [(pytest.approx(first, abs=1e-9), sign > 0), (pytest.approx(second, abs=1e-9), sign < 0)]


def test_a_balance_that_comes_near_zero_and_turns_back_has_no_root():
    assert _found(lambda t: (t - 0.7777) ** 2 + 1e-7) == []


@pytest.mark.parametrize(
    ("balance", "root", "stable"),
    [
        (lambda t: -t, 0.0, True),
        (lambda t: t, 0.0, False),
        (lambda t: 2.0 - t, 2.0, True),
        (lambda t: t - 2.0, 2.0, False),
    ],
)
def test_a_root_at_an_end_of_the_range_counts(balance, root, stable):
    assert _found(balance) == [(pytest.approx(root, abs=1e-12), stable)]


def test_a_root_on_a_scanned_angle_is_found_once():
    assert _found(lambda t: 1.0 - t) == [(pytest.approx(1.0), True)]


def test_no_root_is_no_equilibrium():
    assert _found(lambda t: 1.0 + t) == []


def test_the_roots_do_not_depend_on_the_unit_of_the_moment():
    for scale in (1e-9, 1e9):
        assert len(_found(lambda t, scale=scale: scale * np.cos(3 * t) * (t - 0.7777) ** 2)) == 3
