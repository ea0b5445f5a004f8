"""What a model gives becomes an Answer."""

from collections.abc import Iterable, Mapping

import numpy as np
from jaxtyping import Bool

from myograph.ensemble.pairs.question import Answer
from myograph.errors import InputError
from myograph.fields import FIELDS, von_mises
from myograph.inference.signature import DEVIATION, RESIDUAL


def answer_of(
    outputs: Mapping[str, np.ndarray],
    scales_90: Mapping[str, np.ndarray] | None = None,
    inside: Bool[np.ndarray, " batch"] | None = None,
) -> Answer:
    """Fields, deviations and half widths by name, in double precision; Cauchy stress brings von Mises stress along.

    `scales_90` has one for each pair: see `myograph.inference.ways.scales_of`.
    """
    values = {name: array.astype(np.float64) for name, array in outputs.items() if name in FIELDS}
    if "cauchy_stress" in values and "von_mises" not in values:
        values["von_mises"] = von_mises(values["cauchy_stress"])
    deviation = {
        name.removesuffix(DEVIATION): array.astype(np.float64)
        for name, array in outputs.items()
        if name.endswith(DEVIATION)
    }
    widths = {
        name: scale[:, None] * deviation.get(name, np.ones(values[name].shape[:2]))
        for name, scale in (scales_90 or {}).items()
    }
    return Answer(values, deviation, widths, inside)


def check_outputs(outputs: Iterable[str]) -> None:
    """Raise InputError for a name that no model may give."""
    for name in outputs:
        if name != RESIDUAL and name.removesuffix(DEVIATION) not in FIELDS:
            raise InputError(
                f"unknown output '{name}': expected a field ({', '.join(FIELDS)}), FIELD{DEVIATION}, or {RESIDUAL}"
            )
