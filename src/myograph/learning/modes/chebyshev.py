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
    powers = x.clamp(-1, 1).unsqueeze(-1) ** torch.arange(degree + 1, dtype=x.dtype, device=x.device)
    values, slopes = (torch.tensor(matrix, dtype=x.dtype, device=x.device) for matrix in coefficients(degree))
    return powers @ values, powers @ slopes


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


def products(
    place: Float64[Tensor, "points 2"], degrees: Degrees
) -> tuple[Float64[Tensor, "points terms"], Float64[Tensor, "points terms"], Float64[Tensor, "points terms"]]:
    """All b_jk at (x, u), their slopes along x, and along u."""
    (t, dt), (s, ds) = chebyshev(place[:, 0], degrees[0]), chebyshev(place[:, 1], degrees[1])
    return _outer(t, s), _outer(dt, s), _outer(t, ds)


def _outer(first: Float64[Tensor, "points m"], second: Float64[Tensor, "points n"]) -> Float64[Tensor, "points terms"]:
    return (first[:, :, None] * second[:, None, :]).flatten(1)
