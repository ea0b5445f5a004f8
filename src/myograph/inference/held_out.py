"""Which factorial cases the training of a model held out: certain only where a dataset lists the same ones.

A split draws them by its seed out of the list of the factorial cases; another list, or another order, gives others.
"""

import hashlib
from itertools import product

import numpy as np
from jaxtyping import Float

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import FACTORIAL
from myograph.inference.model_file import Origin

DECIMALS = 9
CORNERS = np.array(list(product((0.0, 1.0), repeat=len(MUSCLES))))
"""Every muscle off or on, the last one changing first: what a model was taught on whose file does not say."""


def factorial_checksum(cases: MuscleCases) -> str:
    """Of the activations of the factorial cases in their order."""
    return _checksum(cases.activation[cases.named(FACTORIAL)])


def same_held_out(origin: Origin, cases: MuscleCases) -> bool:
    """Whether the seed of the model's split draws from these cases what it drew when the model was taught."""
    return cases.checksum == origin.dataset or factorial_checksum(cases) == (origin.factorial or _checksum(CORNERS))


def _checksum(activation: Float[np.ndarray, "cases muscles"]) -> str:
    rounded = np.ascontiguousarray(activation, dtype="<f8").round(DECIMALS) + 0.0
    return hashlib.sha256(f"{len(rounded)} ".encode() + rounded.tobytes()).hexdigest()
