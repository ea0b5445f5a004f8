r"""One field of a muscle: mean and modes at the nodes, the modes' amounts as polynomials of a place (x, u).

    field = mean + sum_k c_k(x, u) φ_k,    c_k(x, u) = sum_j w_jk b_j(x, u),    b_j(x, u) = T_m(x) T_n(u)

T_m are Chebyshev polynomials, and j = m (degree in u + 1) + n. x is the elbow's angle, u the muscle's own activation,
both scaled into ±`RANGE`; what lies beyond ±1 is taken as there.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy.polynomial import chebyshev

RANGE = 0.9


@dataclass(frozen=True)
class LowRankField:
    """A field.

    Parameters
    ----------
    name, components
        As in `myograph.fields.FIELDS`; a scalar has one component.
    mean, modes
        In the field's unit: the modes have length one over all nodes and components.
    degrees
        Highest degree along x and along u.
    weights
        w_jk: how much of the product b_j is in the amount of each mode.
    misfit
        Root mean square over the training cases of what modes and polynomials leave open at each node.
    """

    name: str
    components: int
    mean: Float[np.ndarray, "nodes components"]
    modes: Float[np.ndarray, "modes nodes components"]
    degrees: tuple[int, int]
    weights: Float[np.ndarray, "terms modes"]
    misfit: Float[np.ndarray, " nodes"]

    def amounts(self, x: float, u: float) -> Float[np.ndarray, " modes"]:
        """Amount of each mode at a place."""
        first, second = (_polynomials(along, degree) for along, degree in zip((x, u), self.degrees, strict=True))
        return np.outer(first, second).ravel() @ self.weights

    def slopes(self, x: float, u: float) -> Float[np.ndarray, "2 modes"]:
        """How the amounts change along x and along u."""
        (first, along_x), (second, along_u) = (
            (_polynomials(along, degree), _slopes(along, degree))
            for along, degree in zip((x, u), self.degrees, strict=True)
        )
        return np.stack([np.outer(along_x, second).ravel(), np.outer(first, along_u).ravel()]) @ self.weights

    def values(self, amounts: Float[np.ndarray, " modes"]) -> Float[np.ndarray, "nodes components"]:
        """The field of these amounts."""
        return self.mean + self.changes(amounts)

    def changes(self, amounts: Float[np.ndarray, " modes"]) -> Float[np.ndarray, "nodes components"]:
        """What these changes of the amounts change."""
        return np.tensordot(amounts, self.modes, axes=1)


def _polynomials(along: float, degree: int) -> Float[np.ndarray, " terms"]:
    """T_0 to T_degree."""
    return chebyshev.chebvander(np.clip(along, -1, 1), degree).ravel()


def _slopes(along: float, degree: int) -> Float[np.ndarray, " terms"]:
    """Of T_0 to T_degree."""
    if not degree:
        return np.zeros(1)
    of_each = chebyshev.chebder(np.eye(degree + 1))
    return _polynomials(along, degree - 1) @ of_each
