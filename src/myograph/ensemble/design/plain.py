"""The two designs that the networks' protocols are made of: the corners of the activation cube, and points inside."""

from myograph.case import MUSCLES, Case
from myograph.ensemble.design.points import factorial, latin_hypercube
from myograph.errors import InputError


def factorial_cases(hand_load: float = 0.0) -> tuple[Case, ...]:
    """The 32 activations of {0, 1}^5, the last muscle fastest; load in N."""
    return tuple(Case(tuple(corner), hand_load) for corner in factorial(len(MUSCLES), 1.0).tolist())


def off_grid_cases(count: int, seed: int, hand_load: float = 0.0) -> tuple[Case, ...]:
    """Activations from the open cube (0, 1)^5 by Latin hypercube, seeded; load in N."""
    if count < 1:
        raise InputError(f"number of off-grid cases: expected at least 1, got {count}")
    return tuple(Case(tuple(point), hand_load) for point in latin_hypercube(len(MUSCLES), count, seed).tolist())
