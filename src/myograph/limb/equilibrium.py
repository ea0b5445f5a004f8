"""Where the elbow comes to rest: the angles at which all moments cancel.

The balance is scanned over the whole range and every change of sign is closed in by a bracketed search, so that no
root hides wider than the scan's step. A root is stable where the balance falls with the angle.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.optimize import root_scalar

SCAN = 201
Balance = Callable[[Float[np.ndarray, " points"]], Float[np.ndarray, " points"]]


@dataclass(frozen=True)
class Equilibrium:
    """An angle [rad] at which all moments cancel, and whether the elbow returns to it when pushed."""

    angle: float
    stable: bool


def equilibria(balance: Balance, low: float, high: float) -> tuple[Equilibrium, ...]:
    """All angles in [low, high] at which `balance` (net moment over angles) vanishes, in rising order."""
    angles = np.linspace(low, high, SCAN)
    signs = np.sign(balance(angles))
    before, after = signs[:-1], signs[1:]
    found = [
        Equilibrium(_root(balance, float(angles[k]), float(angles[k + 1])), bool(before[k] > 0))
        for k in np.flatnonzero(before * after < 0)
    ]
    for k in np.flatnonzero(signs == 0):
        left, right = signs[max(k - 1, 0)], signs[min(k + 1, SCAN - 1)]
        found.append(Equilibrium(float(angles[k]), bool(left > 0 or right < 0)))
    return tuple(sorted(found, key=lambda equilibrium: equilibrium.angle))


def _root(balance: Balance, low: float, high: float) -> float:
    return float(root_scalar(lambda angle: float(balance(np.array([angle]))[0]), bracket=(low, high), xtol=1e-10).root)
