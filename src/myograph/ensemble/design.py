"""Which cases to compute: all corners of the activation cube, and random activations inside it."""

from itertools import product

import numpy as np
from scipy.stats import qmc

from myograph.case import MUSCLES, Case
from myograph.errors import InputError


def factorial_cases(hand_load: float = 0.0) -> tuple[Case, ...]:
    """The 32 activations of {0, 1}^5, the last muscle fastest; load in N."""
    return tuple(Case(corner, hand_load) for corner in product((0.0, 1.0), repeat=len(MUSCLES)))


def off_grid_cases(count: int, seed: int, hand_load: float = 0.0) -> tuple[Case, ...]:
    """Activations from the open cube (0, 1)^5 by Latin hypercube, seeded; load in N."""
    if count < 1:
        raise InputError(f"number of off-grid cases: expected at least 1, got {count}")
    points = qmc.LatinHypercube(len(MUSCLES), rng=np.random.default_rng(seed)).random(count)
    return tuple(Case(tuple(map(float, point)), hand_load) for point in points)
