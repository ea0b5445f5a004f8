"""Where the elbow comes to rest: the angles at which all moments cancel.

The balance is scanned over the whole range and every change of sign is closed in by a bracketed search. Where it comes
near zero and turns back, its extremum is searched too: it may touch zero (one double root) or cross it twice between
two angles of the scan. A root is stable where the balance falls through zero: the elbow returns when it is pushed.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.optimize import minimize_scalar, root_scalar

SCAN = 201
"""Angles of the scan: two roots nearer than a step are found where the balance turns back between them."""
ZERO = 1e-11
"""Largest balance that counts as none, over its largest value in the range."""

Balance = Callable[[Float[np.ndarray, " points"]], Float[np.ndarray, " points"]]
At = Callable[[float], float]


@dataclass(frozen=True)
class Equilibrium:
    """An angle [rad] at which all moments cancel, and whether the elbow returns to it when pushed."""

    angle: float
    stable: bool


def equilibria(balance: Balance, low: float, high: float, at: At | None = None) -> tuple[Equilibrium, ...]:
    """All angles in [low, high] at which the net moment vanishes, in rising order.

    Parameters
    ----------
    balance, at
        Net moment over angles; `at`, where given, is the same function for a single angle, faster.
    """
    single = at or (lambda angle: float(balance(np.array([angle]))[0]))
    angles = np.linspace(low, high, SCAN)
    values = balance(angles)
    zero = ZERO * float(np.abs(values).max())
    signs = np.sign(values) * (np.abs(values) > zero)
    before, after = signs[:-1], signs[1:]
    found = [
        _crossing(single, (float(angles[k]), float(angles[k + 1])), bool(before[k] > 0))
        for k in np.flatnonzero(before * after < 0)
    ]
    found += [Equilibrium(float(angles[k]), _falls(signs, int(k))) for k in np.flatnonzero(signs == 0)]
    for k in _turns_near_zero(values, signs):
        found += _about_extremum(single, (float(angles[k - 1]), float(angles[k + 1])), float(signs[k]), zero)
    return tuple(sorted(found, key=lambda equilibrium: equilibrium.angle))


def _crossing(single: At, bracket: tuple[float, float], falls: bool) -> Equilibrium:
    found = root_scalar(single, method="brentq", bracket=bracket, xtol=1e-11, rtol=1e-13)
    return Equilibrium(float(found.root), falls)


def _falls(signs: np.ndarray, k: int) -> bool:
    """Whether the balance falls through its zero at a scanned angle; at an end, what there is of it."""
    from_above = k == 0 or signs[k - 1] > 0
    to_below = k == len(signs) - 1 or signs[k + 1] < 0
    return bool(from_above and to_below)


def _turns_near_zero(values: np.ndarray, signs: np.ndarray) -> list[int]:
    """Scanned angles where |balance| has a minimum whose parabola comes within half its own height of zero."""
    size, sign = np.abs(values), signs
    middle, left, right = size[1:-1], size[:-2], size[2:]
    same = (sign[:-2] == sign[1:-1]) & (sign[2:] == sign[1:-1]) & (sign[1:-1] != 0)
    candidates = np.flatnonzero(same & (middle <= left) & (middle <= right) & (left + right > 2 * middle))
    curved = (left + right - 2 * middle)[candidates]
    deepest = middle[candidates] - (right - left)[candidates] ** 2 / (8 * curved)
    return (candidates[deepest < 0.5 * curved] + 1).tolist()


def _about_extremum(single: At, bracket: tuple[float, float], sign: float, zero: float) -> list[Equilibrium]:
    """None, one or two roots between two angles of the scan where the balance has the same sign at both."""
    options = {"xatol": 1e-9 * (bracket[1] - bracket[0])}
    found: Any = minimize_scalar(lambda x: sign * single(x), bounds=bracket, method="bounded", options=options)
    angle, least = float(found.x), float(found.fun)
    if least > zero:
        return []
    if least >= -zero:
        return [Equilibrium(angle, stable=False)]
    sides = ((bracket[0], angle), (angle, bracket[1]))
    return [_crossing(single, side, falls) for side, falls in zip(sides, (sign > 0, sign < 0), strict=True)]
