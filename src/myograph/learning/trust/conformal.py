r"""Split-conformal intervals for fields: how many deviations hold 90 % of the truth.

    score of a node in a case     s = |predicted - true| / deviation
    factor q                      smallest with  sum_cases w (share of its nodes with s <= q)  >=  0.9 (W + max w)
    interval                      predicted ± q deviation

over calibration cases, which taught nothing; w is the weight of a case, W the sum of all. Where the case asked is
exchangeable with these, or drawn from elsewhere, w is the ratio of both densities and the case asked weighs no more
than max w, a node of it lies in its interval with a probability of at least 0.9, for any method and any number of
cases: nodes of one case depend on each other, so cases are counted, not nodes, and the case asked counts as one that
holds none. In all other cases coverage has to be measured: `myograph.learning.trust.coverage`.
Sources: Papadopoulos et al. 2002; Tibshirani et al. 2019 for weights; Lee, Barber & Willett 2023 for cases of many
nodes.
"""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError

LEVEL = 0.9
SMALLEST = 1e-9
"""Least deviation, in the unit of the field, that scores are divided by."""
ROUNDING = 1e-9


def conformal_factor(
    errors: Float[np.ndarray, "cases nodes"],
    deviations: Float[np.ndarray, "cases nodes"],
    weights: Float[np.ndarray, " cases"] | None = None,
    level: float = LEVEL,
) -> float:
    """q; raises InputError for a level that so few cases cannot promise, and for what is not finite."""
    cases, nodes = errors.shape
    each = np.ones(cases) if weights is None else weights
    total = float(each.sum() + each.max(initial=0.0))
    if not promises(each, level):
        raise InputError(
            f"conformal intervals at level {level:g}: expected a level between 0 and 1 and cases enough for it, "
            f"such as 9 of equal weight for 0.9, got {cases}; hold out more cases"
        )
    scores = errors / np.maximum(deviations, SMALLEST)
    if not np.isfinite(scores).all():
        raise InputError("conformal intervals: expected finite errors and deviations, got NaN or infinity")
    order = np.argsort(scores, axis=None)
    held = np.cumsum(np.repeat(each / nodes, nodes)[order])
    first = int(np.searchsorted(held, level * total * (1 - ROUNDING)))
    return float(scores.ravel()[order[min(first, scores.size - 1)]])


def promises(weights: Float[np.ndarray, " cases"], level: float = LEVEL) -> bool:
    """Whether cases of these weights are enough for that level: W >= level (W + max w)."""
    total = float(weights.sum() + weights.max(initial=0.0))
    return 0 < level < 1 and bool(weights.sum() >= level * total * (1 - ROUNDING))
