r"""Sections of a function of two variables: one variable held, a piecewise polynomial in the other.

s(x, y) = Σ_jk W_jk b_j(x) b_k(y); for a fixed y the coefficients Σ_k W_jk b_k(y) of the b_j are one small matrix
product, and in every cell between two breaks the b_j are polynomials. A section costs some ten microseconds, each of
its values one more: cheap enough to scan a curve and to search its roots.
"""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.interpolation.domain import SLACK
from myograph.interpolation.interpolant import Interpolant


@dataclass(frozen=True, eq=False)
class Cells:
    """Where the cells of a section lie; shared by all sections of a function.

    Parameters
    ----------
    breaks
        Ends of the range and, between them, where cells meet.
    """

    breaks: Float[np.ndarray, " breaks"]

    def check(self, x: float) -> None:
        """Raise InputError for a place outside the range."""
        low, high = self.as_list[0], self.as_list[-1]
        slack = SLACK * (high - low)
        if not low - slack <= x <= high + slack:
            raise InputError(f"expected a place from {low:g} to {high:g}, got {x:g}")

    @cached_property
    def inner(self) -> Float[np.ndarray, " inner"]:
        """The breaks without the ends."""
        return self.breaks[1:-1]

    @cached_property
    def middles(self) -> Float[np.ndarray, " cells"]:
        """Of the cells."""
        return (self.breaks[:-1] + self.breaks[1:]) / 2

    @cached_property
    def halves(self) -> Float[np.ndarray, " cells"]:
        """Half the widths of the cells."""
        return np.diff(self.breaks) / 2

    @cached_property
    def as_list(self) -> list[float]:
        """The breaks as plain numbers, which one place at a time finds faster."""
        return self.breaks.tolist()


@dataclass(frozen=True, eq=False)
class Section:
    """A piecewise polynomial Σ_k c_k s^k, s = (x - middle) / half width in [-1, 1], in physical units.

    Parameters
    ----------
    cells
        Where it is one polynomial each.
    coefficients
        c_k in every cell.
    """

    cells: Cells
    coefficients: Float[np.ndarray, "cells powers"]

    def __call__(self, x: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        """Values; raises InputError outside the range."""
        if x.size:
            self.cells.check(float(x.min()))
            self.cells.check(float(x.max()))
        cell = self.cells.inner.searchsorted(x, side="right")
        s = (x - self.cells.middles[cell]) / self.cells.halves[cell]
        columns = np.ascontiguousarray(self.coefficients.T)
        value = columns[-1][cell]
        for column in columns[-2::-1]:
            value *= s
            value += column[cell]
        return value

    def __add__(self, other: "Section") -> "Section":
        """The sum of two sections with the same breaks and degree."""
        assert self.coefficients.shape == other.coefficients.shape
        return Section(self.cells, self.coefficients + other.coefficients)

    def at(self, x: float) -> float:
        """The value at one place."""
        s, row, _ = self._cell(x)
        value = 0.0
        for coefficient in reversed(row):
            value = value * s + coefficient
        return value

    def slope(self, x: float) -> float:
        """The first derivative at one place."""
        s, row, half = self._cell(x)
        value = 0.0
        for k in range(len(row) - 1, 0, -1):
            value = value * s + k * row[k]
        return value / half

    def _cell(self, x: float) -> tuple[float, list[float], float]:
        """Place in the cell, the cell's coefficients, half its width."""
        self.cells.check(x)
        breaks = self.cells.as_list
        cell = min(max(bisect_right(breaks, x) - 1, 0), len(breaks) - 2)
        if cell not in self._rows:
            self._rows[cell] = self.coefficients[cell].tolist()
        half = (breaks[cell + 1] - breaks[cell]) / 2
        return (x - breaks[cell]) / half - 1, self._rows[cell], half

    @cached_property
    def _rows(self) -> dict[int, list[float]]:
        """Coefficients of the cells that were asked for one place at a time."""
        return {}


class Sections:
    """All sections along the first coordinate of an interpolant with two coordinates and one component.

    Parameters
    ----------
    breaks
        Places of the first coordinate, in [0, 1] of its range, where cells shall meet beside those of the splines:
        sections with the same cells add up to one section.

    Raises InputError for any other interpolant.
    """

    def __init__(self, interpolant: Interpolant, breaks: Float[np.ndarray, " breaks"] | None = None) -> None:
        grid, surpluses = interpolant.grid, interpolant.surpluses
        if grid.dimension != 2 or surpluses.size != len(grid):
            raise InputError(
                "expected an interpolant of two coordinates with one component, "
                f"got {grid.dimension} and {surpluses.size // len(grid)}"
            )
        (first, rows), (second, columns) = (
            np.unique(np.stack([grid.levels[:, k], grid.indices[:, k]], axis=1), axis=0, return_inverse=True)
            for k in range(2)
        )
        weights = np.zeros((len(first), len(second)))
        weights[rows.reshape(-1), columns.reshape(-1)] = surpluses.reshape(-1)
        along = interpolant.basis.functions(first[:, 0], first[:, 1])
        along = along if breaks is None else along.refined(breaks)
        cells, powers, functions = along.coefficients.shape
        self._held = interpolant.basis.functions(second[:, 0], second[:, 1])
        self._matrix = along.coefficients.reshape(cells * powers, functions) @ weights
        self._shape = (cells, powers)
        self._low, self._high = (float(bound) for bound in (interpolant.domain.lower[1], interpolant.domain.upper[1]))
        self._inner = along.inner_breaks
        unit = np.concatenate([[0.0], along.inner_breaks, [1.0]])
        self._cells = Cells(interpolant.domain.lower[0] + unit * interpolant.domain.widths[0])

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Where cells meet, in [0, 1] of the range of the first coordinate; its ends are left out."""
        return self._inner

    def held(self, y: float, derivative: int = 0) -> Section:
        """The section at y, or that of a derivative of s by y; raises InputError outside the range of y."""
        width = self._high - self._low
        if not self._low - SLACK * width <= y <= self._high + SLACK * width:
            raise InputError(f"expected a place from {self._low:g} to {self._high:g}, got {y:g}")
        unit = min(max((y - self._low) / width, 0.0), 1.0)
        if derivative:
            values = self._held(np.array([unit]), derivative)[0] / width**derivative
        else:
            values = self._held.at(unit)
        return Section(self._cells, (self._matrix @ values).reshape(self._shape))
