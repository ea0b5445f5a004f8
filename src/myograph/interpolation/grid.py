r"""Sparse grids: points of the unit cube by level and index, regular or refined where it pays.

Regular grid of level n in d dimensions: all points of levels l >= 1 with |l|_1 <= n + d - 1, indices odd. With
boundary points, levels may be 0 (indices 0 and 1) and a level 0 counts as 1 in |l|_1: every face then carries the
regular grid of level n in its own d - 1 dimensions, as fine as the inside.

A grid is closed if with every point it holds the point's parents in every dimension. Regular grids are, refined ones
stay so. The order of points never changes by refinement: new ones come last.
Source: Bungartz & Griebel 2004; Pflüger 2010 for the refinement.
"""

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Bool, Float, Int

from myograph.errors import InputError
from myograph.interpolation import tree
from myograph.interpolation.spacing import spaced

if TYPE_CHECKING:
    from myograph.interpolation.basis import Basis


@dataclass(frozen=True, eq=False)
class SparseGrid:
    """Points by level and index (points, dimension) in every dimension.

    Raises InputError for levels and indices that do not belong together, and for a point that comes twice.
    """

    levels: Int[np.ndarray, "points dimension"]
    indices: Int[np.ndarray, "rows columns"]

    def __post_init__(self) -> None:
        if self.levels.ndim != 2 or self.levels.shape != self.indices.shape or not self.levels.size:
            raise InputError(
                "expected levels and indices of one shape (points, dimension), "
                f"got {self.levels.shape} and {self.indices.shape}"
            )
        known = np.where(
            self.levels == 0,
            (self.indices == 0) | (self.indices == 1),
            (self.levels > 0) & (self.indices % 2 == 1) & (self.indices >> self.levels.clip(0) == 0),
        )
        if not known.all():
            row, k = np.argwhere(~known)[0]
            raise InputError(
                "expected an odd index below 2^level, or level 0 with index 0 or 1, "
                f"got level {self.levels[row, k]}, index {self.indices[row, k]} in point {row}"
            )
        if len(tree.keys(self.levels, self.indices)) != len(self.levels):
            raise InputError(f"expected every point once, got a point twice among {len(self.levels)}")

    def __len__(self) -> int:
        return len(self.levels)

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return self.levels.shape[1]

    @property
    def boundary(self) -> bool:
        """Whether some points lie on the boundary."""
        return bool((self.levels == 0).any())

    @classmethod
    def regular(cls, dimension: int, level: int, boundary: bool = False) -> "SparseGrid":
        """Regular grid, coarse levels first: the grid of level n - 1 is the beginning of the grid of level n.

        Raises InputError for a dimension or a level below 1.
        """
        if dimension < 1 or level < 1:
            raise InputError(f"expected dimension and level of at least 1, got {dimension} and {level}")
        chosen = sorted(_level_vectors(dimension, level + dimension - 1, 0 if boundary else 1), key=_fineness)
        levels, indices = [], []
        for vector in chosen:
            block = np.array(list(product(*(_indices(one) for one in vector))))
            indices.append(block)
            levels.append(np.tile(vector, (len(block), 1)))
        return cls(np.concatenate(levels), np.concatenate(indices))

    def coordinates(self, spacing: "str | Basis") -> Float[np.ndarray, "points dimension"]:
        """Points in the unit cube for a spacing, 'uniform' or 'clenshaw_curtis', or for that of a basis."""
        return spaced(self.levels, self.indices, spacing if isinstance(spacing, str) else spacing.spacing)

    def refined(self, chosen: Bool[np.ndarray, " points"] | Int[np.ndarray, " chosen"]) -> "SparseGrid":
        """The grid with the children of the chosen points (a mask, or their numbers) and all missing ancestors.

        A point has two children in every dimension, (l + 1, 2 i ± 1); a boundary point has (1, 1) there.
        Raises InputError for a point that is not there.
        """
        mask = chosen.dtype == bool
        if (mask and len(chosen) != len(self)) or (not mask and ((chosen < 0) | (chosen >= len(self))).any()):
            raise InputError(
                f"expected a mask of {len(self)} points or numbers from 0 to {len(self) - 1}, got {chosen}"
            )
        known = tree.keys(self.levels, self.indices)
        for point in tree.keys(self.levels[chosen], self.indices[chosen]):
            for child in tree.children(point):
                tree.add_with_ancestors(known, child, self.boundary)
        levels, indices = np.moveaxis(np.array(list(known)), 2, 0)
        return SparseGrid(levels, indices)

    def surplus_refined(
        self,
        surpluses: Float[np.ndarray, "points ..."],
        count: int | None = None,
        tolerance: float | None = None,
        by_volume: bool = False,
    ) -> "SparseGrid":
        """The grid refined at its largest surpluses: at `count` points, or wherever they exceed `tolerance`.

        Parameters
        ----------
        surpluses
            Coefficients of an interpolant on this grid; a point counts by the Euclidean norm over its components.
        by_volume
            Multiply the norm by 2^-|l|_1, the volume that a function covers.

        Only points that lack a child are candidates. Raises InputError unless just one of count and tolerance is given.
        """
        if (count is None) == (tolerance is None) or (count is not None and count < 1):
            raise InputError(
                f"expected either a count of at least 1 or a tolerance, got count {count}, tolerance {tolerance}"
            )
        if len(surpluses) != len(self):
            raise InputError(f"expected surpluses of {len(self)} points, got {len(surpluses)}")
        known = tree.keys(self.levels, self.indices)
        size = np.linalg.norm(surpluses.reshape(len(self), -1), axis=1)
        size *= 2.0 ** -self.levels.sum(axis=1) if by_volume else 1.0
        size[[all(child in known for child in tree.children(point)) for point in known]] = -np.inf
        order = np.argsort(-size, kind="stable")
        chosen = order[size[order] > (0.0 if tolerance is None else tolerance)]
        return self.refined(chosen[:count])


def _level_vectors(dimension: int, budget: int, lowest: int) -> list[tuple[int, ...]]:
    """All level vectors whose sum, a 0 counted as 1, is within the budget."""
    if dimension == 0:
        return [()]
    first = range(lowest, budget - dimension + 2)
    return [(one, *rest) for one in first for rest in _level_vectors(dimension - 1, budget - max(one, 1), lowest)]


def _fineness(vector: tuple[int, ...]) -> int:
    """|l|_1 with a 0 counted as 1."""
    return sum(max(one, 1) for one in vector)


def _indices(level: int) -> range:
    """Indices of the points of one level in one dimension."""
    return range(1, 2**level, 2) if level else range(2)
