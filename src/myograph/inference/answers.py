"""What a model gives becomes an Answer."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from jaxtyping import Bool

from myograph.ensemble.pairs.question import Answer
from myograph.errors import InputError, NotConvergedError
from myograph.fields import FIELDS, value_shape, von_mises
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


def joined(parts: Sequence[Answer]) -> Answer:
    """Answers of one model to some cases after the others, as one."""
    verdicts = [part.inside for part in parts if part.inside is not None]
    return Answer(
        *(
            {name: np.concatenate([getattr(part, kind)[name] for part in parts]) for name in getattr(parts[0], kind)}
            for kind in ("values", "deviation", "half_width_90")
        ),
        inside=np.concatenate(verdicts) if verdicts else None,
    )


def check_given(outputs: Mapping[str, np.ndarray], pairs: int, queries: int) -> None:
    """Raise InputError for what a network gives in another shape or kind than it should, NotConvergedError for NaN."""
    for name, array in outputs.items():
        shape = _shape(name, pairs, queries)
        if array.shape != shape or array.dtype.kind != "f":
            raise InputError(f"the network gives {name} of shape {array.shape} and {array.dtype}, expected {shape}")
        if not np.isfinite(array).all():
            raise NotConvergedError(f"the network gives {name} that is not finite: ask within what it was trained on")


def _shape(name: str, pairs: int, queries: int) -> tuple[int, ...]:
    if name == RESIDUAL:
        return (pairs,)
    return (pairs, queries) if name.endswith(DEVIATION) else (pairs, queries, *value_shape(name))


def check_outputs(outputs: Iterable[str]) -> None:
    """Raise InputError for a name that no model may give."""
    for name in outputs:
        if name != RESIDUAL and name.removesuffix(DEVIATION) not in FIELDS:
            raise InputError(
                f"unknown output '{name}': expected a field ({', '.join(FIELDS)}), FIELD{DEVIATION}, or {RESIDUAL}"
            )
