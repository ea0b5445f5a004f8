"""The features of `myograph.ensemble.pairs.features` in torch, so that they are part of an exported network.

Trap: the direction of a point that does not move is zero, and its derivative must not be NaN.
"""

from collections.abc import Mapping

import torch
from jaxtyping import Float
from torch import Tensor

from myograph.ensemble.pairs.features import FIELD, WIDTH, Feature

MOVED: tuple[Feature, ...] = ("displacement", "direction_and_scale")
"""Features that need the place in the initial case."""
SMALLEST_MM = 1e-6
"""A way shorter than this has no direction [mm]."""

Fields = Mapping[str, Tensor]


def feature_of(kind: Feature, initial: Tensor | None, target: Fields) -> Float[Tensor, "batch points width"]:
    """A feature [mm], [MPa] from the positions S in the initial case and the fields in the target case."""
    after = target[FIELD[kind]]
    if kind == "coordinates" or kind == "cauchy_stress":
        return after
    if kind == "von_mises":
        return after[..., None]
    assert initial is not None
    moved = after - initial
    if kind == "displacement":
        return moved
    scale = length(moved)
    return torch.cat([moved / scale.clamp_min(SMALLEST_MM), scale], dim=-1)


def field_of(kind: Feature, values: Float[Tensor, "batch points width"], initial: Tensor | None) -> Tensor:
    """The field in the target case that a feature's values say; undoes `feature_of`."""
    if kind == "von_mises":
        return values[..., 0]
    if kind == "coordinates" or kind == "cauchy_stress":
        return values
    assert initial is not None
    if kind == "displacement":
        return initial + values
    way, scale = values[..., :3], values[..., 3:]
    return initial + way / length(way).clamp_min(SMALLEST_MM) * scale


def length(vectors: Float[Tensor, "*batch 3"]) -> Float[Tensor, "*batch 1"]:
    """Euclidean length; its derivative at zero is zero."""
    return vectors.square().sum(dim=-1, keepdim=True).clamp_min(SMALLEST_MM**2).sqrt()


def width_of(kinds: tuple[Feature, ...]) -> int:
    """Numbers at a point of these features together."""
    return sum(WIDTH[kind] for kind in kinds)
