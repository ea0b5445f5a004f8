"""Course of the rates: share of the largest one, at a share of the training.

    one_cycle   up in a line during the first fifth, down in a cosine
    cosine      down in a cosine
    constant    1

Source: Smith & Topin 2018 for the one-cycle rate.
"""

import math

from myograph.learning.training.config import Schedule

RISE = 0.2
"""Share of the training in which the one-cycle rate goes up."""


def rate_at(schedule: Schedule, share: float) -> float:
    """Rate over its largest value [-] when this share of the training is done."""
    if schedule == "constant":
        return 1.0
    if schedule == "cosine":
        return _fall(share)
    return share / RISE if share < RISE else _fall((share - RISE) / (1 - RISE))


def _fall(share: float) -> float:
    return (1 + math.cos(math.pi * min(share, 1))) / 2
