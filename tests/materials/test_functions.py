"""The helpers that laws are built with."""

import numpy as np
import pytest

from myograph.materials.along_and_cross import acosh_squared
from myograph.materials.functions import NUMPY, Functions, clamped, positive


def test_numpy_offers_all_functions():
    assert isinstance(NUMPY, Functions)
    values = [NUMPY.sqrt(4.0), NUMPY.exp(1.0), NUMPY.log(np.e), NUMPY.erf(10.0)]
    assert values == pytest.approx([2.0, np.e, 1.0, 1.0])


def test_where_takes_the_first_only_where_its_condition_is_positive():
    assert NUMPY.where(np.array([-1.0, 0.0, 1.0]), 1.0, 2.0).tolist() == [2.0, 2.0, 1.0]


def test_the_positive_part_is_smooth_and_never_zero():
    assert positive(-3.0, 0.1, NUMPY) > 0
    assert positive(3.0, 0.1, NUMPY) == pytest.approx(3.0, abs=1e-3)
    assert (positive(1e-6, 0.1, NUMPY) - positive(-1e-6, 0.1, NUMPY)) / 2e-6 == pytest.approx(0.5)


def test_clamped_holds_values_at_both_ends():
    assert clamped(np.array([0.0, 1.2, 3.0]), 1.0, 2.0, NUMPY).tolist() == [1.0, 1.2, 2.0]


def test_the_square_of_acosh_is_exact_on_both_sides_of_its_switch():
    x = 1 + np.array([1e-9, 1e-3, 0.05, 0.0999, 0.1001, 0.3, 4.0])
    assert acosh_squared(x, NUMPY) == pytest.approx(np.arccosh(x) ** 2, rel=1e-7)
    near, beyond = acosh_squared(1.1 + np.array([-1e-13, 1e-13]), NUMPY)
    assert near == pytest.approx(beyond, rel=1e-12)


def test_the_square_of_acosh_is_straight_through_the_reference_and_below_it():
    """2 (x - 1), without a root of anything negative on the way."""
    with np.errstate(divide="raise", invalid="raise"):
        assert acosh_squared(np.array([1 - 1e-9, 1.0, 1 + 1e-9]), NUMPY) == pytest.approx([-2e-9, 0.0, 2e-9], rel=1e-6)
