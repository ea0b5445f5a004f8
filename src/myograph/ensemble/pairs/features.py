"""Quantities at a point in the initial and the target case, as networks take and give them.

    coordinates           T                          3
    displacement          T - S                      3
    direction_and_scale   (T - S)/|T - S|, |T - S|   4    the direction of a point that does not move is zero
    von_mises             von Mises stress           1    in the target case
    cauchy_stress         Cauchy stress              6    in the target case

Any of them may go in and any other come out: `feature` of a question's sensors, and of its queries and the truth;
`field_values` makes the field of what a network gives for the queries.
Source: thesis sections 6.2.1 to 6.2.3.
"""

from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
from jaxtyping import Float

from myograph.ensemble.pairs.question import FieldValues
from myograph.errors import InputError

Feature = Literal["coordinates", "displacement", "direction_and_scale", "von_mises", "cauchy_stress"]
FEATURES: tuple[Feature, ...] = get_args(Feature)
WIDTH: dict[Feature, int] = {
    "coordinates": 3,
    "displacement": 3,
    "direction_and_scale": 4,
    "von_mises": 1,
    "cauchy_stress": 6,
}
FIELD: dict[Feature, str] = {
    "coordinates": "position",
    "displacement": "position",
    "direction_and_scale": "position",
    "von_mises": "von_mises",
    "cauchy_stress": "cauchy_stress",
}
"""The field that a feature is made of, and that it answers."""


def check_feature(kind: str) -> None:
    """Raise InputError for a name that is none of the features."""
    if kind not in FEATURES:
        raise InputError(f"feature: expected one of {', '.join(FEATURES)}, got '{kind}'")


def fields_of(kinds: Sequence[Feature]) -> tuple[str, ...]:
    """The fields that these features are made of: what a sampler must tell or ask for them."""
    for kind in kinds:
        check_feature(kind)
    return tuple(dict.fromkeys(FIELD[kind] for kind in kinds))


def feature(kind: Feature, initial: FieldValues, target: FieldValues) -> Float[np.ndarray, "batch points width"]:
    """The feature of points, in mm and MPa; raises InputError where its field is not among those of the points."""
    check_feature(kind)
    if FIELD[kind] not in target:
        raise InputError(
            f"feature '{kind}': expected the field '{FIELD[kind]}', got {', '.join(target) or 'none'}; "
            "make the sampler tell it (`known`) or ask for it (`asked`)"
        )
    after = target[FIELD[kind]]
    if kind == "coordinates" or kind == "cauchy_stress":
        return after
    if kind == "von_mises":
        return after[..., None]
    moved = after - initial["position"]
    if kind == "displacement":
        return moved
    scale = np.linalg.norm(moved, axis=-1, keepdims=True)
    return np.concatenate([_unit(moved), scale], axis=-1)


def field_values(
    kind: Feature, values: Float[np.ndarray, "batch points width"], initial: FieldValues
) -> Float[np.ndarray, "batch points ..."]:
    """The field in the target case that a feature's values say; undoes `feature`.

    A direction that is not of unit length is made so, and one of length zero does not move. Raises InputError for
    values of another width than the feature's.
    """
    check_feature(kind)
    if values.shape[-1] != WIDTH[kind]:
        raise InputError(f"feature '{kind}': expected {WIDTH[kind]} numbers at each point, got {values.shape[-1]}")
    if kind == "von_mises":
        return values[..., 0]
    if kind == "coordinates" or kind == "cauchy_stress":
        return values
    if kind == "displacement":
        return initial["position"] + values
    return initial["position"] + _unit(values[..., :3]) * values[..., 3:]


def _unit(vectors: Float[np.ndarray, "batch points 3"]) -> Float[np.ndarray, "batch points 3"]:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)
