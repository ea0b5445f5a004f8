"""Millimetres to what a network sees and back, isotropically: one length for all axes, so that shapes are kept.

    position   x = (X - lowest) / length,   length = longest side of the box around the training positions
    feature    v = (V - offset) / unit

Trap: in raw millimetres the representer's softmax is one-hot, and node positions receive no gradient.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.ensemble.pairs.features import WIDTH, Feature, feature
from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.question import FieldValues
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError

LOOKED_AT = 256
"""Pairs, at most, that the scaling is made from."""
SAME = 1e-9
"""Values that differ by less than this share of the largest are the same everywhere."""


@dataclass(frozen=True)
class Units:
    """Offset and unit of a feature, in its own units, for each of its numbers."""

    offset: Float[np.ndarray, " width"]
    unit: Float[np.ndarray, " width"]


@dataclass(frozen=True)
class Scaling:
    """The box around the training positions and the scales of the features.

    Parameters
    ----------
    lowest
        Corner of the box with the smallest coordinates [mm].
    sides
        Its lengths along the axes [mm].
    features
        Units of the features that are used.
    """

    lowest: Float[np.ndarray, " axes"]
    sides: Float[np.ndarray, " axes"]
    features: dict[Feature, Units]

    @property
    def length(self) -> float:
        """Longest side of the box [mm]: what becomes 1."""
        return float(self.sides.max())


def blank_scaling(features: Iterable[Feature]) -> Scaling:
    """A unit cube and units of one, to be overwritten by those of a saved model."""
    units: dict[Feature, Units] = {kind: Units(np.zeros(WIDTH[kind]), np.ones(WIDTH[kind])) for kind in features}
    return Scaling(np.zeros(3), np.ones(3), units)


def fit_scaling(sampler: PairSampler, pairs: PairSet, features: Iterable[Feature], seed: int = 0) -> Scaling:
    """Scaling that suits some of these pairs of cases, drawn at random; other cases are not looked at.

    Raises InputError where the positions span no volume, or nothing moves in any pair.
    """
    looked_at = _some(pairs, seed)
    kinds = tuple(dict.fromkeys(features))
    fields = {"position", *(("von_mises",) if "von_mises" in kinds else ())}
    fields |= {"cauchy_stress"} if "cauchy_stress" in kinds else set()
    before, after = (
        {name: sampler.cases.values(name, looked_at[:, role]).astype(np.float64) for name in fields} for role in (0, 1)
    )
    positions = np.concatenate([before["position"], after["position"]]).reshape(-1, 3)
    places = positions if sampler.convention == "initial" else sampler.cases.body.reference
    lowest, sides = places.min(axis=0), np.ptp(places, axis=0)
    if not sides.min() > 0:
        raise InputError(f"training positions: expected a body in space, got a box with the sides {sides.tolist()} mm")
    if not np.abs(after["position"] - before["position"]).max() > 0:
        raise InputError(f"expected pairs of cases between which something moves, got {len(pairs)} where nothing does")
    return Scaling(lowest, sides, {kind: _units(kind, before, after) for kind in kinds})


def _some(pairs: PairSet, seed: int) -> np.ndarray:
    if len(pairs) <= LOOKED_AT:
        return pairs.all()
    return pairs.draw(np.random.default_rng(seed), LOOKED_AT)


def _units(kind: Feature, before: FieldValues, after: FieldValues) -> Units:
    """Root mean square for what may be zero; mean and half the shortest side for positions; deviation for stress."""
    values = feature(kind, before, after).reshape(-1, WIDTH[kind])
    mean, zero, one = values.mean(axis=0), np.zeros(WIDTH[kind]), np.ones(WIDTH[kind])
    root_mean_square = np.sqrt(np.square(values).mean())
    if kind == "coordinates":
        return Units(values.min(axis=0) + np.ptp(values, axis=0) / 2, one * np.ptp(values, axis=0).min() / 2)
    if kind == "displacement":
        return Units(zero, one * root_mean_square)
    if kind == "direction_and_scale":
        return Units(zero, np.array([1.0, 1.0, 1.0, np.sqrt(np.square(values[:, 3]).mean())]))
    deviation = float(values.std(axis=0).max())
    return Units(mean, one * (deviation if deviation > SAME * np.abs(values).max() else 1.0))
