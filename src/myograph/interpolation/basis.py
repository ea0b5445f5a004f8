r"""Bases of hierarchical B-splines by name, and their functions of one variable with two derivatives.

A function of d variables is the product of d of these. `families` says which spline each of them is.
Source: Valentin 2019, B-Splines for Sparse Grids; the names of its implementation SG++ stand in docs/interpolation.md.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.interpolation import families
from myograph.interpolation.piecewise import PiecewisePolynomials

DEGREES = (1, 3, 5)
"""Degrees that a basis may have."""

FINEST = 12
"""Finest level that a function may have; its splines have 2^FINEST knots."""


@dataclass(frozen=True)
class Basis:
    """Hierarchical functions of one variable.

    Parameters
    ----------
    name
        As `basis` takes it.
    degree
        Of the piecewise polynomials.
    spacing
        Of the grid points that belong to the functions, 'uniform' or 'clenshaw_curtis'.
    boundary
        Whether there are functions on level 0; without them a grid must not have boundary points.
    family
        The splines of one level.
    """

    name: str
    degree: int
    spacing: str
    boundary: bool
    family: families.Family

    def functions(
        self, levels: Int[np.ndarray, " functions"], indices: Int[np.ndarray, " functions"]
    ) -> PiecewisePolynomials:
        """The functions of these levels and indices, prepared for many evaluations.

        Raises InputError for a level that the basis does not have.
        """
        lowest = 0 if self.boundary else 1
        if not ((levels >= lowest) & (levels <= FINEST)).all():
            wrong = levels[(levels < lowest) | (levels > FINEST)][0]
            raise InputError(f"expected levels from {lowest} to {FINEST} for the basis '{self.name}', got {wrong}")
        present = np.unique(levels)
        splines = [self.family(self.degree, int(level), indices[levels == level]) for level in present]
        made = np.concatenate([np.flatnonzero(levels == level) for level in present])
        return PiecewisePolynomials.from_splines(splines).reordered(np.argsort(made))

    def value(
        self,
        levels: Int[np.ndarray, " functions"],
        indices: Int[np.ndarray, " functions"],
        x: Float[np.ndarray, " points"],
    ) -> Float[np.ndarray, "points functions"]:
        """Values at places in [0, 1]; raises InputError outside."""
        return self.functions(levels, indices)(_inside(x), 0)

    def first_derivative(
        self,
        levels: Int[np.ndarray, " functions"],
        indices: Int[np.ndarray, " functions"],
        x: Float[np.ndarray, " points"],
    ) -> Float[np.ndarray, "points functions"]:
        """First derivatives at places in [0, 1]; from the right where they jump; raises InputError outside."""
        return self.functions(levels, indices)(_inside(x), 1)

    def second_derivative(
        self,
        levels: Int[np.ndarray, " functions"],
        indices: Int[np.ndarray, " functions"],
        x: Float[np.ndarray, " points"],
    ) -> Float[np.ndarray, "points functions"]:
        """Second derivatives at places in [0, 1], for degree 1 zero everywhere; raises InputError outside."""
        return self.functions(levels, indices)(_inside(x), 2)


_FAMILIES: dict[str, tuple[str, bool, families.Family]] = {
    "uniform": ("uniform", True, families.uniform),
    "modified": ("uniform", False, families.modified),
    "clenshaw_curtis": ("clenshaw_curtis", True, families.clenshaw_curtis),
    "modified_clenshaw_curtis": ("clenshaw_curtis", False, families.modified_clenshaw_curtis),
    "not_a_knot": ("uniform", True, families.not_a_knot),
    "modified_not_a_knot": ("uniform", False, families.modified_not_a_knot),
}

BASES = tuple(_FAMILIES)
"""Names of the bases."""


def basis(name: str, degree: int = 3) -> Basis:
    """The basis of this name (one of BASES) and degree (1, 3 or 5); raises InputError for any other."""
    if name not in _FAMILIES:
        raise InputError(f"expected a basis among {', '.join(BASES)}, got '{name}'")
    if degree not in DEGREES:
        raise InputError(f"expected a degree of 1, 3 or 5, got {degree}")
    return Basis(name, degree, *_FAMILIES[name])


def _inside(x: np.ndarray) -> np.ndarray:
    """The places, none of them outside [0, 1]."""
    if not ((x >= 0) & (x <= 1)).all():
        raise InputError(f"expected places from 0 to 1, got {x[~((x >= 0) & (x <= 1))][0]:g}")
    return x
