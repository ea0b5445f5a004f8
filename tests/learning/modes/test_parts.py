"""The mathematics that neural modes are made of."""

import numpy as np
import pytest
import torch

from myograph.errors import InputError
from myograph.fields import von_mises
from myograph.learning.modes import stress
from myograph.learning.modes.chebyshev import chebyshev, products
from myograph.learning.modes.marquardt import Course, _linearised, _start, _values, fit_network
from myograph.learning.modes.pod import proper_modes
from myograph.learning.modes.ridge import eliminate, ridge_amounts
from myograph.learning.modes.surface import RIDGE, fit_surface

GENERATOR = np.random.default_rng(0)


def test_modes_of_snapshots_of_rank_three_rebuild_them_and_are_orthonormal():
    values = 5 + GENERATOR.normal(size=(12, 3)) @ GENERATOR.normal(size=(3, 40))
    pod = proper_modes(values, 8)
    assert len(pod.modes) == 3
    assert np.allclose(pod.mean + pod.amounts @ pod.modes, values)
    assert np.allclose(pod.modes @ pod.modes.T, np.eye(3))
    assert (np.diff(pod.spread) <= 0).all()


@pytest.mark.parametrize(("values", "says"), [(np.ones((1, 4)), "at least 2 cases"), (np.ones((5, 4)), "that differ")])
def test_modes_need_snapshots_that_differ(values, says):
    with pytest.raises(InputError, match=says):
        proper_modes(values, 3)


def test_chebyshev_polynomials_and_their_slopes_are_those_of_numpy():
    x = np.linspace(-0.95, 0.95, 7)
    values, slopes = chebyshev(torch.tensor(x), 6)
    for k in range(7):
        polynomial = np.polynomial.Chebyshev.basis(k)
        assert np.allclose(values[:, k], polynomial(x))
        assert np.allclose(slopes[:, k], polynomial.deriv()(x))


def test_beyond_the_ends_chebyshev_polynomials_stay_as_they_are_there():
    values, slopes = chebyshev(torch.tensor([-3.0, 1.0], dtype=torch.float64), 4)
    assert values[0].tolist() == [1, -1, 1, -1, 1]
    assert slopes[1].tolist() == [0, 1, 4, 9, 16]


def test_a_constant_is_the_chebyshev_polynomial_of_degree_zero():
    values, slopes = chebyshev(torch.tensor([0.3], dtype=torch.float64), 0)
    assert values.tolist() == [[1.0]]
    assert slopes.tolist() == [[0.0]]


def test_slopes_of_products_are_those_of_automatic_differentiation():
    place = torch.tensor([[0.3, -0.7], [-0.2, 0.9]], dtype=torch.float64, requires_grad=True)
    values, along_x, along_u = products(place, (4, 3)).unbind(dim=1)
    for term in (0, 7, 19):
        (slope,) = torch.autograd.grad(values[:, term].sum(), place, retain_graph=True)
        assert torch.allclose(slope, torch.stack([along_x[:, term], along_u[:, term]], dim=1))


def test_a_surface_that_is_a_polynomial_is_found_exactly():
    place = GENERATOR.uniform(-0.95, 0.95, size=(80, 2))
    x, u = place.T
    amounts = np.stack([x**3 * u - x, 2 * x**2 + u**2], axis=1)
    surface = fit_surface(place, amounts)
    found = products(torch.tensor(place), surface.degrees)[:, 0].numpy() @ surface.weights
    assert np.allclose(found, amounts, atol=1e-6)
    assert surface.left_out < 1e-6


def test_the_error_of_left_out_cases_is_that_of_fits_without_them():
    place, amounts = GENERATOR.uniform(-0.95, 0.95, size=(12, 2)), GENERATOR.normal(size=(12, 1))
    surface = fit_surface(place, amounts)
    terms = products(torch.tensor(place), surface.degrees)[:, 0].numpy()
    missed = []
    for case in range(12):
        rest = np.arange(12) != case
        square = terms[rest].T @ terms[rest] + 12 * RIDGE * np.eye(terms.shape[1])
        missed.append(amounts[case] - terms[case] @ np.linalg.solve(square, terms[rest].T @ amounts[rest]))
    assert surface.left_out == pytest.approx(np.sqrt(np.square(missed).mean()), rel=1e-6)


def test_degrees_follow_how_many_different_values_there_are():
    place = np.stack([np.linspace(-0.9, 0.9, 60), np.tile([-0.9, 0.9], 30)], axis=1)
    assert fit_surface(place, np.sin(9 * place[:, :1]) * place[:, 1:]).degrees[1] <= 1


def test_a_single_place_has_a_constant_surface():
    assert fit_surface(np.zeros((3, 2)), np.ones((3, 1))).degrees == (0, 0)


def test_the_jacobian_of_a_small_network_is_that_of_finite_differences():
    inputs, target = GENERATOR.normal(size=(4, 3)), GENERATOR.normal(size=4)
    parameters = _start(np.random.default_rng(1), 3, 5)
    residual, jacobian = _linearised(parameters, inputs, target, 5)
    assert np.allclose(residual, _values(parameters, inputs, 5) - target)
    for number in range(len(parameters)):
        step = np.zeros_like(parameters)
        step[number] = 1e-6
        slope = (_values(parameters + step, inputs, 5) - _values(parameters - step, inputs, 5)) / 2e-6
        assert np.allclose(jacobian[:, number], slope, atol=1e-7)


def test_a_small_network_learns_a_smooth_function_and_reports_every_step():
    inputs = np.linspace(-1, 1, 60)[:, None]
    told = []
    weights = fit_network(inputs, np.sin(2 * inputs[:, 0]), Course(6, 200, 0.0), (0,), lambda *step: told.append(step))
    hidden = np.tanh(inputs @ weights.first.T + weights.first_offset)
    hidden = np.tanh(hidden @ weights.second.T + weights.second_offset)
    assert np.abs(hidden @ weights.last + weights.last_offset - np.sin(2 * inputs[:, 0])).max() < 1e-3
    assert [step for step, _ in told] == list(range(1, len(told) + 1))
    assert told[-1][1] < told[0][1]


def test_a_network_that_has_come_to_rest_stops():
    told = []
    fit_network(np.zeros((5, 1)), np.zeros(5), Course(2, 500, 1e-3), (0,), lambda *step: told.append(step))
    assert len(told) < 100


def test_elimination_solves_what_numpy_solves():
    root = GENERATOR.normal(size=(6, 6))
    matrix, right = root @ root.T + np.eye(6), GENERATOR.normal(size=(6, 2))
    found = eliminate(torch.tensor(matrix), torch.tensor(right)).numpy()
    assert np.allclose(found, np.linalg.solve(matrix, right))


def test_elimination_keeps_all_digits_where_pivots_are_large():
    draw = np.random.default_rng(4)
    half = draw.normal(size=(5, 40)) * 1e5
    matrix, right = half @ half.T + np.eye(5), half @ draw.normal(size=(40, 3))
    found = eliminate(torch.tensor(matrix), torch.tensor(right)).numpy()
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=1e-12)


def test_ridge_amounts_minimise_misfit_and_size():
    modes, spread, noise = GENERATOR.normal(size=(6, 3)), np.array([2.0, 1.0, 0.3]), 0.2
    missed = GENERATOR.normal(size=(4, 6))
    found = ridge_amounts(torch.tensor(missed), torch.tensor(modes), torch.tensor(spread), noise).numpy()
    stacked = np.concatenate([modes / noise, np.diag(1 / spread)])
    for case in range(4):
        wanted = np.linalg.lstsq(stacked, np.concatenate([missed[case] / noise, np.zeros(3)]), rcond=None)[0]
        assert np.allclose(found[case], wanted)


def test_without_sensors_ridge_amounts_are_zero():
    none = ridge_amounts(torch.zeros(2, 0), torch.zeros(0, 3), torch.ones(3), 0.1)
    assert none.tolist() == [[0.0] * 3] * 2


def test_von_mises_in_torch_is_the_one_of_the_fields():
    values = GENERATOR.normal(size=(5, 6))
    assert np.allclose(stress.von_mises(torch.tensor(values)).numpy(), von_mises(values))


def test_the_change_of_von_mises_is_its_derivative():
    values, change = GENERATOR.normal(size=(2, 5, 6))
    found = stress.von_mises_change(torch.tensor(values), torch.tensor(change)).numpy()
    ahead, behind = von_mises(values + 1e-6 * change), von_mises(values - 1e-6 * change)
    assert np.allclose(found, (ahead - behind) / 2e-6)
