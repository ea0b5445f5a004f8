"""Millimetres to what a network sees and back, isotropically: one length for all axes, so that shapes are kept.

    position   x = (X - lowest) / length,   length = longest side of the box around the training positions
    value      v = (V - offset) / unit

Trap: in raw millimetres the representer's softmax is one-hot, and node positions receive no gradient.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError

Target = Literal["coordinates", "displacement"]


@dataclass(frozen=True)
class Scaling:
    """The box around the training positions and the scale of the values.

    Parameters
    ----------
    lowest
        Corner of the box with the smallest coordinates [mm].
    sides
        Its lengths along the axes [mm].
    target
        Values are positions T ('coordinates') or T - S ('displacement').
    offset
        Of the values [mm]: centre of the box, or zero.
    unit
        Of the values [mm]: half the shortest side, or the root mean square of the training displacements.
    """

    lowest: tuple[float, float, float]
    sides: tuple[float, float, float]
    target: Target
    offset: tuple[float, float, float]
    unit: float

    @property
    def length(self) -> float:
        """Longest side of the box [mm]: what becomes 1."""
        return max(self.sides)

    @property
    def unit_sides(self) -> Float[np.ndarray, " axes"]:
        """Sides of the box over its longest one [-]."""
        return np.array(self.sides) / self.length

    def into_box(self, positions: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
        """Coordinates in the unit box [-] of positions [mm]."""
        return (positions - np.array(self.lowest)) / self.length

    def out_of_box(self, coordinates: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
        """Positions [mm] of coordinates in the unit box [-]."""
        return coordinates * self.length + np.array(self.lowest)

    def values(
        self, initial: Float[np.ndarray, "*batch 3"], target: Float[np.ndarray, "*batch 3"]
    ) -> Float[np.ndarray, "*batch 3"]:
        """Values [-] of points that go from S = `initial` to T = `target` [mm]."""
        moved = target - initial if self.target == "displacement" else target
        return (moved - np.array(self.offset)) / self.unit

    def targets(
        self, initial: Float[np.ndarray, "*batch 3"], values: Float[np.ndarray, "*batch 3"]
    ) -> Float[np.ndarray, "*batch 3"]:
        """Positions T [mm] of points at S = `initial` [mm] with these values [-]; undoes `values`."""
        moved = values * self.unit + np.array(self.offset)
        return initial + moved if self.target == "displacement" else moved


def fit_scaling(
    positions: Float[np.ndarray, "cases nodes 3"], pairs: Int[np.ndarray, "pairs 2"], target: Target
) -> Scaling:
    """Scaling that suits these pairs of cases; other cases are not looked at.

    Raises InputError where the positions span no volume, or nothing moves in any pair.
    """
    used = positions[np.unique(pairs)].reshape(-1, 3)
    lowest, sides = used.min(axis=0), np.ptp(used, axis=0)
    if not sides.min() > 0:
        raise InputError(f"training positions: expected a body in space, got a box with the sides {sides.tolist()} mm")
    squares = [np.square(positions[j] - positions[i]).mean() for i, j in pairs]
    displacement = float(np.sqrt(np.mean(squares)))
    if not displacement > 0:
        raise InputError(f"expected pairs of cases between which something moves, got {len(pairs)} where nothing does")
    if target == "displacement":
        return Scaling(_triple(lowest), _triple(sides), target, (0.0, 0.0, 0.0), displacement)
    return Scaling(_triple(lowest), _triple(sides), target, _triple(lowest + sides / 2), float(sides.min() / 2))


def _triple(values: Float[np.ndarray, " 3"]) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z
