"""Antiderivatives of curves without a closed form."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import expi

from myograph.materials.conventions import POWER
from myograph.materials.functions import NUMPY
from myograph.materials.primitive import evaluated, primitive
from myograph.materials.toe import ExponentialToe
from tests.materials.cases import EXAMPLES, along_fibre


def test_the_primitive_of_a_reciprocal_is_the_logarithm():
    pieces = primitive(lambda x: 1 / x, (0.4, 1.0, 2.5))
    x = np.linspace(0.4, 2.5, 99)
    assert evaluated(pieces, x, NUMPY) == pytest.approx(np.log(x / 0.4), rel=1e-8, abs=1e-10)


def test_beyond_the_ends_the_primitive_is_held():
    pieces = primitive(np.exp, (0.0, 1.0))
    assert evaluated(pieces, np.array([-3.0, 7.0]), NUMPY) == pytest.approx([0.0, np.e - 1], abs=1e-12)


def test_a_kink_inside_is_found_by_halving():
    pieces = primitive(lambda x: np.abs(x - 1 / 3), (0.0, 1.0))
    assert len(pieces) > 3
    assert evaluated(pieces, np.array(1.0), NUMPY) == pytest.approx(1 / 18 + 2 / 9, rel=1e-8)


@pytest.mark.parametrize("power", [2.0, 2.5, 3.0, 4.0, 6.0])
@pytest.mark.parametrize("convention", POWER)
def test_the_active_energy_of_roehrle_is_the_integral_of_its_bell(power, convention):
    change = {"power_ascending": power, "power_descending": power, "convention": convention}
    law = EXAMPLES["roehrle muscle"].model_copy(update=change)

    def stress(x):
        width = law.width_descending if x > law.l_opt else law.width_ascending
        return law.sigma_max * x ** POWER[law.convention] * np.exp(-(np.abs((x / law.l_opt - 1) / width) ** power))

    for low, high in ((0.8, 1.2), (1.2, 1.5), (1.4, 2.1)):
        work, _ = quad(stress, low, high, points=[law.l_opt], epsabs=1e-12, epsrel=1e-12)
        ends = law.active(along_fibre(np.array([low, high])), NUMPY)
        assert ends[1] - ends[0] == pytest.approx(work, rel=1e-8)


def test_an_exponential_toe_is_the_exponential_integral():
    """∫ A (exp(B (l - 1)) - 1) / l dl = A (exp(-B) (Ei(B l) - Ei(B)) - ln l)."""
    A, B = 2.7, 46.4
    x = np.linspace(1.001, 1.03, 31)
    exact = A * (np.exp(-B) * (expi(B * x) - expi(B)) - np.log(x))
    assert ExponentialToe(A, B, 1.03, 300.0).energy(x, NUMPY) == pytest.approx(exact, rel=1e-6, abs=1e-12)


def test_a_toe_is_slack_below_and_straight_beyond():
    toe, step = ExponentialToe(0.2, 10.0, 1.1, 20.0), 1e-6

    def stress(x):
        return x * (toe.energy(x + step, NUMPY) - toe.energy(x - step, NUMPY)) / (2 * step)

    last = 0.2 * (np.exp(1.0) - 1)
    assert stress(0.9) == pytest.approx(0.0, abs=1e-12)
    assert stress(1.1 + 1e-5) == pytest.approx(last, rel=1e-3)
    assert stress(1.3) == pytest.approx(last + 20.0 * 0.2, rel=1e-7)
