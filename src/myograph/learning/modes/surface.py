r"""Amounts of the modes over (x, u): least squares on products of Chebyshev polynomials.

    c_k(x, u) = sum_j w_jk b_j(x, u),    w = (BᵀB + ε n I)⁻¹ Bᵀ c

The degrees are those with the least error of cases left out, one at a time, which needs no second fit:

    e_i = r_i / (1 - h_i),   h = diag(B (BᵀB + ε n I)⁻¹ Bᵀ)

Source: Allen 1974 for the sum of squares of e.
"""

from dataclasses import dataclass

import numpy as np
import torch
from jaxtyping import Float
from scipy.linalg import solve_triangular

from myograph.learning.modes.chebyshev import Degrees, products

FIRST_DEGREES, SECOND_DEGREES = (1, 2, 3, 4, 6, 8, 10, 12, 16), (0, 1, 2, 3, 4, 6, 8)
RIDGE = 1e-10
"""ε: keeps the least squares solvable where cases leave a polynomial open."""
MOST_TERMS = 0.4
"""Number of terms over number of cases, at most."""


@dataclass(frozen=True)
class Surface:
    """Weights of the terms for each mode, and the root mean square of what left-out cases miss, in the field's unit."""

    degrees: Degrees
    weights: Float[np.ndarray, "terms modes"]
    left_out: float


def fit_surface(place: Float[np.ndarray, "cases 2"], amounts: Float[np.ndarray, "cases modes"]) -> Surface:
    """The best surface through the amounts at the places (x, u), both within ±RANGE."""
    found = [_fit(place, amounts, degrees) for degrees in _candidates(place)]
    return min(found, key=lambda surface: surface.left_out)


def _candidates(place: Float[np.ndarray, "cases 2"]) -> list[Degrees]:
    """Degrees that the different values along each axis, and the number of cases, can tell apart."""
    first, second = (len(np.unique(np.round(along, 6))) - 1 for along in place.T)
    most = max(MOST_TERMS * len(place), 1)
    pairs = [(i, j) for i in FIRST_DEGREES if i <= first for j in SECOND_DEGREES if j <= second]
    return [(i, j) for i, j in pairs if (i + 1) * (j + 1) <= most] or [(0, 0)]


def _fit(place: Float[np.ndarray, "cases 2"], amounts: Float[np.ndarray, "cases modes"], degrees: Degrees) -> Surface:
    terms = products(torch.tensor(place), degrees)[:, 0].numpy()
    square = terms.T @ terms + RIDGE * len(terms) * np.eye(terms.shape[1])
    lower = np.linalg.cholesky(square)
    half = solve_triangular(lower, terms.T, lower=True)
    weights = solve_triangular(lower, half @ amounts, lower=True, trans=1)
    missed = (amounts - terms @ weights) / np.maximum(1 - np.square(half).sum(axis=0), 1e-6)[:, None]
    return Surface(degrees, weights, float(np.sqrt(np.square(missed).sum(axis=1).mean())))
