r"""A box in physical units, seen as the unit cube.

x = (X - lower) / (upper - lower); a derivative by X is one by x divided by the width, a second one by two widths.
A point a rounding error outside, 1e-9 of the width, is taken as lying on the edge.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError

SLACK = 1e-9
"""How far outside a point may lie, as a share of the width."""


@dataclass(frozen=True, eq=False)
class Domain:
    """Lower and upper bounds (dimension,) of each coordinate, in any unit.

    Raises InputError for bounds that differ in number, are not finite, or do not increase.
    """

    lower: Float[np.ndarray, " lower"]
    upper: Float[np.ndarray, " upper"]

    def __post_init__(self) -> None:
        if self.lower.ndim != 1 or self.lower.shape != self.upper.shape:
            raise InputError(
                f"expected as many lower as upper bounds, got shapes {self.lower.shape} and {self.upper.shape}"
            )
        bad = np.flatnonzero(~(np.isfinite(self.lower) & np.isfinite(self.upper) & (self.lower < self.upper)))
        if len(bad):
            k = bad[0]
            raise InputError(
                f"expected finite bounds, lower < upper, got {self.lower[k]:g} and {self.upper[k]:g} for coordinate {k}"
            )

    @classmethod
    def unit(cls, dimension: int) -> "Domain":
        """The unit cube."""
        return cls(np.zeros(dimension), np.ones(dimension))

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return len(self.lower)

    @cached_property
    def widths(self) -> Float[np.ndarray, " dimension"]:
        """Upper minus lower bound."""
        return self.upper - self.lower

    def from_unit(self, points: Float[np.ndarray, "*batch dimension"]) -> Float[np.ndarray, "*batch dimension"]:
        """Points of the unit cube in the box's units."""
        return self.lower + points * self.widths

    def to_unit(self, points: Float[np.ndarray, "*batch coordinates"]) -> Float[np.ndarray, "*batch coordinates"]:
        """Points of the box in the unit cube.

        Raises InputError for a wrong number of coordinates, and for a point outside, naming its coordinate.
        """
        if points.ndim == 0 or points.shape[-1] != self.dimension:
            raise InputError(f"expected points of shape (..., {self.dimension}), got {points.shape}")
        unit = (points - self.lower) / self.widths
        if not unit.size or (unit.min() >= 0.0 and unit.max() <= 1.0):
            return unit
        inside = np.clip(unit, 0.0, 1.0)
        outside = np.abs(unit - inside).reshape(-1, self.dimension)
        if not outside.max() <= SLACK:
            self._refuse(points.reshape(-1, self.dimension), outside)
        return inside

    def _refuse(self, points: np.ndarray, outside: np.ndarray) -> None:
        """Name the first coordinate that is outside or not a number."""
        row, k = np.argwhere(~(outside <= SLACK))[0]
        raise InputError(
            f"expected coordinate {k} from {self.lower[k]:g} to {self.upper[k]:g}, "
            f"got {points[row, k]:g} in point {row}"
        )
