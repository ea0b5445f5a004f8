r"""Interpolants on sparse grids: from values at the grid points to a function with gradient and Hessian.

s(x) = Σ_j α_j φ_j(x) with s(x_i) = f_i at all grid points. The surpluses α solve A α = f, A_ij = φ_j(x_i); one
factorisation of A serves any number of components. Derivatives are exact and in the units of the domain.
Source: Valentin 2019, B-Splines for Sparse Grids.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod

import numpy as np
from jaxtyping import Float
from scipy.linalg import lu_factor, lu_solve
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from myograph.errors import InputError, NotConvergedError
from myograph.interpolation.basis import Basis
from myograph.interpolation.domain import Domain
from myograph.interpolation.grid import SparseGrid
from myograph.interpolation.products import GridFunctions

DENSE = 0.1
"""Share of entries that are not zero above which the matrix is factorised as a dense one."""

RESIDUAL = 1e-8
"""Largest residual of the solve, as a share of the largest value."""

_BLOCK = 2**20


@dataclass(frozen=True, eq=False)
class Interpolant:
    """A function on a box, with any number of components.

    Parameters
    ----------
    grid, basis, domain
        What it is made of.
    surpluses
        Coefficients of the hierarchical functions, in the unit of the values.
    functions
        The hierarchical functions on the unit cube.
    """

    grid: SparseGrid
    basis: Basis
    domain: Domain
    surpluses: Float[np.ndarray, "points ..."]
    functions: GridFunctions

    def __call__(self, points: Float[np.ndarray, "*batch dimension"]) -> Float[np.ndarray, "*shape"]:
        """Values (*batch, *components); raises InputError outside the domain, naming the coordinate."""
        blocks = [self.functions.values(block) @ self._flat for block in self._blocks(points)]
        values = blocks[0] if len(blocks) == 1 else np.concatenate(blocks)
        return values.reshape((*points.shape[:-1], *self.surpluses.shape[1:]))

    def gradient(self, points: Float[np.ndarray, "*batch dimension"]) -> Float[np.ndarray, "*shape"]:
        """First derivatives (*batch, *components, dimension); raises InputError outside the domain."""
        unit = np.eye(self.grid.dimension, dtype=int).tolist()
        return self._derivatives(points, [tuple(row) for row in unit]) / self.domain.widths

    def hessian(self, points: Float[np.ndarray, "*batch dimension"]) -> Float[np.ndarray, "*shape"]:
        """Second derivatives (*batch, *components, dimension, dimension); raises InputError outside the domain."""
        first, second = np.triu_indices(self.grid.dimension)
        unit = np.eye(self.grid.dimension, dtype=int)
        upper = self._derivatives(points, [tuple(row) for row in (unit[first] + unit[second]).tolist()])
        result = np.empty((*upper.shape[:-1], self.grid.dimension, self.grid.dimension))
        result[..., first, second] = result[..., second, first] = upper
        return result / (self.domain.widths[:, None] * self.domain.widths)

    def _derivatives(self, points: np.ndarray, orders: Sequence[tuple[int, ...]]) -> np.ndarray:
        """Partial derivatives (*batch, *components, orders) on the unit cube."""
        blocks = [
            np.stack([functions @ self._flat for functions in self.functions.derivatives(block, orders)], axis=-1)
            for block in self._blocks(points)
        ]
        return np.concatenate(blocks).reshape(*points.shape[:-1], *self.surpluses.shape[1:], len(orders))

    def _blocks(self, points: np.ndarray) -> list[np.ndarray]:
        """The points in the unit cube, so many at a time that tables of all functions stay small."""
        unit = self.domain.to_unit(points).reshape(-1, self.grid.dimension)
        step = max(1, _BLOCK // len(self.grid))
        return [unit[start : start + step] for start in range(0, max(1, len(unit)), step)]

    @cached_property
    def _flat(self) -> np.ndarray:
        return self.surpluses.reshape(len(self.grid), -1)


class Hierarchizer:
    """The factorised matrix of a grid and a basis: makes interpolants of any values on that grid.

    Raises InputError for a basis or a domain that does not fit the grid.
    """

    def __init__(self, grid: SparseGrid, basis: Basis, domain: Domain | None = None) -> None:
        self.grid, self.basis, self.domain = grid, basis, domain or Domain.unit(grid.dimension)
        if self.domain.dimension != grid.dimension:
            raise InputError(f"expected a domain of {grid.dimension} dimensions, got {self.domain.dimension}")
        self._functions = GridFunctions(grid, basis)
        self._matrix = _matrix(self._functions, grid.coordinates(basis))
        self._solve = _factorised(self._matrix)

    @property
    def points(self) -> Float[np.ndarray, "points dimension"]:
        """Where the values are wanted, in the units of the domain."""
        return self.domain.from_unit(self.grid.coordinates(self.basis))

    def interpolant(self, values: Float[np.ndarray, "points ..."]) -> Interpolant:
        """The interpolant of values at the grid points.

        Raises InputError for values of another number of points or that are not finite, and NotConvergedError if
        the functions of the grid are not independent.
        """
        _check(values, self.points)
        flat = values.reshape(len(self.grid), -1)
        surpluses = self._solve(flat)
        residual = np.abs(self._matrix @ surpluses - flat).max(initial=0.0)
        largest = np.abs(flat).max(initial=0.0)
        if not residual <= RESIDUAL * largest:
            raise NotConvergedError(
                f"expected a residual below {RESIDUAL:g} of the largest value {largest:g}, got {residual:g}; "
                "use a grid that holds the parents of all its points"
            )
        return Interpolant(self.grid, self.basis, self.domain, surpluses.reshape(values.shape), self._functions)


def interpolate(
    grid: SparseGrid, basis: Basis, values: Float[np.ndarray, "points ..."], domain: Domain | None = None
) -> Interpolant:
    """The interpolant of values at `grid.coordinates(basis)`, in the units of the domain (the unit cube if None).

    Raises InputError and NotConvergedError as `Hierarchizer` does; use that for several sets of values on one grid.
    """
    return Hierarchizer(grid, basis, domain).interpolant(values)


def _matrix(functions: GridFunctions, x: np.ndarray) -> np.ndarray | csc_array:
    """All functions at all grid points; sparse if few entries are not zero."""
    step = max(1, _BLOCK // len(x))
    blocks = [functions.values(x[start : start + step]) for start in range(0, len(x), step)]
    filled = sum(np.count_nonzero(block) for block in blocks) / len(x) ** 2
    matrix = np.concatenate(blocks)
    return matrix if filled > DENSE else csc_array(matrix)


def _factorised(matrix: np.ndarray | csc_array) -> Callable[[np.ndarray], np.ndarray]:
    """Solver for many right-hand sides."""
    if isinstance(matrix, np.ndarray):
        factors = lu_factor(matrix)
        return lambda values: lu_solve(factors, values)
    return splu(matrix).solve


def _check(values: np.ndarray, points: np.ndarray) -> None:
    """Refuse values of another number of points, or that are not finite."""
    if values.ndim == 0 or len(values) != len(points):
        raise InputError(f"expected values of shape ({len(points)}, ...), got {values.shape}")
    finite = np.isfinite(values.reshape(len(points), prod(values.shape[1:]))).all(axis=1)
    if not finite.all():
        first = int(np.flatnonzero(~finite)[0])
        place = ", ".join(f"{one:g}" for one in points[first])
        raise InputError(
            f"expected finite values, got {np.count_nonzero(~finite)} points whose values are not, "
            f"the first is point {first} at ({place})"
        )
