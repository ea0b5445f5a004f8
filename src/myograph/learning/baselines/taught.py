"""What the training cases of a split tell, in memory: for methods that answer from the target case alone.

A method that knows no initial case learns from the target cases of the training pairs, each once. The positions of
1,775 cases of 4,027 nodes take 86 MB.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.fields import FIELDS

LEAST_CASES = 5
"""Cases from which the smallest of these methods can learn anything."""


@dataclass(frozen=True)
class Taught:
    """The training cases.

    Parameters
    ----------
    activation
        Of each case [-].
    fields
        Field -> values of each case at all nodes; a scalar has one component.
    """

    activation: Float[np.ndarray, "cases muscles"]
    fields: Mapping[str, Float[np.ndarray, "cases nodes _"]]

    def __len__(self) -> int:
        return len(self.activation)


def taught_cases(split: Split) -> Int[np.ndarray, " cases"]:
    """Target cases of the training pairs; raises InputError where these are too few to learn from."""
    cases = np.unique(split.train.target)
    if len(cases) < LEAST_CASES:
        raise InputError(f"expected at least {LEAST_CASES} training cases, got {len(cases)}; run a larger ensemble")
    return cases


def taught(sampler: PairSampler, split: Split) -> Taught:
    """All that is asked, in the training cases.

    Raises InputError where these are too few, or differ in their load: for such a method only activations differ.
    """
    chosen = taught_cases(split)
    loads = np.unique(sampler.cases.hand_load[chosen])
    if len(loads) > 1:
        raise InputError(
            f"hand_load: expected the same in all training cases, got {len(loads)} from {loads[0]} N to {loads[-1]} N; "
            "this method answers from activations alone: take cases of one load"
        )
    fields = {name: _with_components(sampler.cases.values(name, chosen)) for name in answered_fields(sampler.asked)}
    return Taught(sampler.cases.activation[chosen], fields)


def answered_fields(asked: tuple[str, ...]) -> tuple[str, ...]:
    """What a method answers where it is asked these fields; von Mises stress follows from Cauchy stress."""
    return tuple(name for name in asked if name != "von_mises" or "cauchy_stress" not in asked)


def components_of(field: str) -> int:
    """Numbers of a field at a node."""
    return max(1, len(FIELDS[field].components))


def _with_components(values: Float[np.ndarray, "cases nodes ..."]) -> Float[np.ndarray, "cases nodes _"]:
    return values[..., None] if values.ndim == 2 else values
