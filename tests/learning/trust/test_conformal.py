"""Intervals that hold what they promise."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.trust.conformal import conformal_factor


def draw(generator, cases, nodes=5):
    """Errors whose size differs from case to case, and deviations that know it in part."""
    size = generator.lognormal(size=(cases, 1))
    return size * np.abs(generator.normal(size=(cases, nodes))), np.sqrt(size) * np.ones((cases, nodes))


@pytest.mark.parametrize("cases", [9, 19, 60])
def test_a_new_exchangeable_case_is_covered_as_promised(cases):
    """Finite-sample guarantee: at least 0.9, and no more than the quantile of so few cases forces."""
    generator, held = np.random.default_rng(cases), []
    for _ in range(1500):
        factor = conformal_factor(*draw(generator, cases))
        errors, deviations = draw(generator, 1)
        held.append((errors <= factor * deviations).mean())
    slack = 4 * np.std(held) / np.sqrt(len(held))
    assert 0.9 - slack <= np.mean(held) <= 0.9 + 1 / (cases + 1) + slack


def test_the_factor_is_the_score_that_nine_of_ten_cases_need():
    errors = np.arange(1.0, 20.0)[:, None]
    assert conformal_factor(errors, np.full((19, 1), 2.0)) == 18 / 2


def test_cases_drawn_from_elsewhere_are_covered_by_the_ratio_of_densities():
    """Calibrated where one case in four is hard, asked where one in two is."""
    generator, held = np.random.default_rng(1), []
    for _ in range(1500):
        hard = generator.uniform(size=60) < 0.25
        errors = np.abs(generator.normal(size=(60, 3))) * np.where(hard, 3, 1)[:, None]
        factor = conformal_factor(errors, np.ones((60, 3)), np.where(hard, 1, 1 / 3))
        asked = np.abs(generator.normal(size=3)) * (3 if generator.uniform() < 0.5 else 1)
        held.append((asked <= factor).mean())
    slack = 4 * np.std(held) / np.sqrt(len(held))
    assert 0.9 - slack <= np.mean(held) <= 0.9 + 1 / 20 + slack


def test_deviations_that_know_the_errors_make_one_factor_for_all():
    errors = np.random.default_rng(0).uniform(1, 5, size=(30, 4))
    assert conformal_factor(errors, errors) == pytest.approx(1)


@pytest.mark.parametrize(("cases", "level"), [(8, 0.9), (30, 1.0), (30, 0.0)])
def test_a_level_that_so_few_cases_cannot_promise_is_refused(cases, level):
    with pytest.raises(InputError, match="hold out more cases"):
        conformal_factor(np.ones((cases, 2)), np.ones((cases, 2)), level=level)


def test_errors_that_are_not_finite_are_refused():
    with pytest.raises(InputError, match="finite errors"):
        conformal_factor(np.full((20, 1), np.nan), np.ones((20, 1)))
