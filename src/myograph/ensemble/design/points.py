r"""Points of the unit cube [0, 1]^d, by method.

    factorial         all k/n in every dimension, n = 1/step: (n + 1)^d points, the last dimension fastest
    tenths            random multiples of 0.1, none twice; the first n of n + m draws are the n draws
    sobol             scrambled Sobol sequence; the first n of n + m points are the n points
    latin_hypercube   one point in each of n slices of every dimension; not nested
    sparse_grid       a regular sparse grid without boundary; level n is the beginning of level n + 1

The same seed gives the same points. The trap: a Latin hypercube of more points shares none with one of fewer.
scipy.stats takes half a second to import, which workers need not wait for.
Source: scipy.stats.qmc for sobol and latin_hypercube; Bungartz & Griebel 2004 for sparse grids.
"""

import math
from itertools import product

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.interpolation import SparseGrid

MOST_POINTS = 1_000_000
"""A design of more is refused: it is a mistake in the step, the level or the number of dimensions."""


def factorial(dimension: int, step: float) -> Float[np.ndarray, "points dimension"]:
    """All multiples of the step; raises InputError where 1/step is no whole number."""
    intervals = round(1 / step) if 0 < step <= 1 else 0
    if intervals < 1 or not math.isclose(intervals * step, 1, rel_tol=1e-9):
        raise InputError(f"step: expected 1 over a whole number, such as 1.0, 0.5 or 0.25, got {step:g}")
    _check_size((intervals + 1) ** dimension, "a larger step")
    levels = (np.arange(intervals + 1) / intervals).tolist()
    return np.array(list(product(levels, repeat=dimension)))


def tenths(dimension: int, count: int, seed: int) -> Float[np.ndarray, "points dimension"]:
    """Different random points of {0, 0.1, ..., 1}^d; raises InputError where there are fewer than asked."""
    _check_size(count, "fewer cases")
    if count > 11**dimension:
        raise InputError(f"count: expected at most the {11**dimension} multiples of 0.1, got {count}")
    draw = np.random.default_rng(seed)
    found: dict[tuple[int, ...], None] = {}
    while len(found) < count:
        found[tuple(draw.integers(0, 11, dimension).tolist())] = None
    return np.array(list(found)) / 10


def sobol(dimension: int, count: int, seed: int) -> Float[np.ndarray, "points dimension"]:
    """The beginning of a scrambled Sobol sequence."""
    _check_size(count, "fewer cases")
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimension, scramble=True, rng=np.random.default_rng(seed))
    return sequence.random_base2(math.ceil(math.log2(count)))[:count]


def latin_hypercube(dimension: int, count: int, seed: int) -> Float[np.ndarray, "points dimension"]:
    """One point in each slice of every dimension."""
    _check_size(count, "fewer cases")
    from scipy.stats import qmc

    return qmc.LatinHypercube(dimension, rng=np.random.default_rng(seed)).random(count)


def sparse_grid(dimension: int, level: int) -> Float[np.ndarray, "points dimension"]:
    """Points of the regular sparse grid, equally spaced in every dimension."""
    if level > 8:
        raise InputError(f"level: expected at most 8, got {level}")
    return SparseGrid.regular(dimension, level).coordinates("uniform")


def _check_size(points: int, remedy: str) -> None:
    if points > MOST_POINTS:
        raise InputError(f"expected at most {MOST_POINTS:,} cases, got {points:,}; take {remedy}")
