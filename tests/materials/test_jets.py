"""Numbers with derivatives: against closed forms and differences, where all branches meet."""

import numpy as np
import pytest

from myograph.materials.functions import NUMPY, Functions
from myograph.materials.jets import JETS, Jet

X, Y = np.array([0.7, 1.3, 2.1]), np.array([1.9, 0.4, 0.8])

EXPRESSIONS = {
    "product": lambda x, y, f: x * y * x,
    "square of one": lambda x, y, f: x * x,
    "quotient": lambda x, y, f: (x - 2) / (y + x),
    "numbers before": lambda x, y, f: 2 - 3 / x + 0.5 * -y,
    "powers": lambda x, y, f: x**-0.4 * y**3 + y**2 + x**1,
    "root": lambda x, y, f: f.sqrt(x * y + 1),
    "exponential and logarithm": lambda x, y, f: f.exp(-x) * f.log(y + 1),
    "error function": lambda x, y, f: f.erf(x / 2) * y,
    "branches": lambda x, y, f: f.where(x - 1, x * y, f.log(x)) + f.where(y - 1, 2.0, y),
    "arrays": lambda x, y, f: np.array([1.0, 2.0, 3.0]) * x + y * np.array([3.0, 1.0, 2.0]),
}

expressions = pytest.mark.parametrize("expression", EXPRESSIONS.values(), ids=EXPRESSIONS.keys())


def _of(expression, x, y, second=True):
    return expression(Jet.variable(0, x, second), Jet.variable(1, y, second), JETS)


def test_jets_offer_all_functions():
    assert isinstance(JETS, Functions)


@expressions
def test_values_are_those_of_numbers(expression):
    assert _of(expression, X, Y).value == pytest.approx(expression(X, Y, NUMPY), rel=1e-14)


@expressions
def test_first_derivatives_are_differences_of_values(expression):
    found, step = _of(expression, X, Y).first, 1e-6
    for k, (dx, dy) in enumerate(((step, 0.0), (0.0, step))):
        low, high = (expression(X + s * dx, Y + s * dy, NUMPY) for s in (-1, 1))
        assert np.broadcast_to(found.get(k, 0.0), 3) == pytest.approx((high - low) / (2 * step), rel=1e-7, abs=1e-9)


@expressions
def test_second_derivatives_are_differences_of_first_ones(expression):
    found, step = _of(expression, X, Y).second, 1e-6
    for j, (dx, dy) in enumerate(((step, 0.0), (0.0, step))):
        low, high = (_of(expression, X + s * dx, Y + s * dy, second=False).first for s in (-1, 1))
        for i in range(j + 1):
            difference = (high.get(i, 0.0) - low.get(i, 0.0)) / (2 * step)
            assert np.broadcast_to(found.get((i, j), 0.0), 3) == pytest.approx(difference, rel=1e-7, abs=1e-8)


def test_what_vanishes_everywhere_is_not_kept():
    only_x = JETS.exp(Jet.variable(0, X)) + 1.0
    assert set(only_x.first) == {0}
    assert set(only_x.second) == {(0, 0)}


def test_constants_stay_constants():
    assert JETS.sqrt(4.0) == 2
    assert JETS.exp(0.0) == 1
    assert JETS.log(1.0) == 0
    assert JETS.erf(0.0) == 0
    assert JETS.where(1.0, 2.0, 3.0) == 2
