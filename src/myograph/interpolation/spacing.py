r"""Points of the unit interval by level l and index i, nested from level to level.

uniform: x_{l,i} = i 2^-l; Clenshaw–Curtis: x_{l,i} = (1 - cos(π i 2^-l)) / 2, denser near 0 and 1.
A point of level l >= 1 has an odd index; level 0 has the two ends, i = 0 and 1.
"""

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError


def spaced(
    levels: Int[np.ndarray, "*shape"], indices: Int[np.ndarray, "*shape"], spacing: str
) -> Float[np.ndarray, "*shape"]:
    """The points x_{l,i}; raises InputError for an unknown spacing."""
    places = indices * 2.0**-levels
    if spacing == "uniform":
        return places
    if spacing == "clenshaw_curtis":
        return (1 - np.cos(np.pi * places)) / 2
    raise InputError(f"expected a spacing 'uniform' or 'clenshaw_curtis', got '{spacing}'")


def level_points(level: int, spacing: str) -> Float[np.ndarray, " points"]:
    """All 2^l + 1 points of a level and the coarser ones, ends included."""
    indices = np.arange(2**level + 1)
    return spaced(np.full_like(indices, level), indices, spacing)
