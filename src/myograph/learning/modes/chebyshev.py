r"""Products of Chebyshev polynomials of two variables, and their slopes.

    T_0 = 1,  T_1 = x,  T_{k+1} = 2 x T_k - T_{k-1},    b_jk(x, u) = T_j(x) T_k(u)

They are made of powers, x^i times the coefficients of T_k, which are few operations; at degree 16 that costs five of
the sixteen digits of double precision. What lies beyond ±1 is taken as there; training lies within ±`RANGE`.
"""

from functools import cache

import numpy as np
import torch
from jaxtyping import Float, Float64
from torch import Tensor

Degrees = tuple[int, int]
"""Highest degree in x and in u."""
RANGE = 0.9


def chebyshev(
    x: Float64[Tensor, " points"], degree: int
) -> tuple[Float64[Tensor, "points terms"], Float64[Tensor, "points terms"]]:
    """T_0 to T_degree and their slopes."""
    found = _with_slopes(x.unsqueeze(-1), degree)
    return found[:, : degree + 1], found[:, degree + 1 :]


@cache
def coefficients(degree: int) -> tuple[Float[np.ndarray, "powers terms"], Float[np.ndarray, "powers terms"]]:
    """Of x^i in T_k, and in its slope."""
    values, slopes = np.zeros((2, degree + 1, degree + 1))
    for k in range(degree + 1):
        polynomial = np.polynomial.Chebyshev.basis(k).convert(kind=np.polynomial.Polynomial)
        values[: k + 1, k] = polynomial.coef
        if k:
            slopes[:k, k] = polynomial.deriv().coef
    return values, slopes


def products(place: Float64[Tensor, "points 2"], degrees: Degrees) -> Float64[Tensor, "points 3 terms"]:
    """All b_jk at (x, u), their slopes along x, and along u.

    In few operations: a network that is asked for one case waits for their number, not for their size.
    """
    x, u = place.split(1, dim=1)
    first = _with_slopes(x, degrees[0]).reshape(-1, 1, 2, degrees[0] + 1, 1)
    second = _with_slopes(u, degrees[1]).reshape(-1, 2, 1, 1, degrees[1] + 1)
    return (first * second).reshape(-1, 4, (degrees[0] + 1) * (degrees[1] + 1))[:, :3]


def _with_slopes(x: Float64[Tensor, "points 1"], degree: int) -> Float64[Tensor, "points terms"]:
    """T_0 to T_degree, then their slopes."""
    powers = x.clamp(-1, 1) ** torch.arange(degree + 1, dtype=x.dtype, device=x.device)
    return powers @ torch.tensor(np.concatenate(coefficients(degree), axis=1), dtype=x.dtype, device=x.device)
