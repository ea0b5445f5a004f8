r"""Proper orthogonal decomposition (POD): a field of many cases by its mean and a few modes.

u(case) = mean + sum_k c_k(case) φ_k + rest, with orthonormal φ_k that leave the smallest rest (squares over all cases).
From the Gram matrix of the cases, G = Y Yᵀ = U diag(s²) Uᵀ for centred Y: φ = Yᵀ u / s, c = s u.
Convention: the modes are those of plain sums over nodes, not of integrals over the body.
Trap: s comes from the root of an eigenvalue, so that modes below `NOISE` of the largest are left out.
Source: Sirovich 1987 (method of snapshots).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.linalg import eigh

NOISE = 1e-7
"""Modes weaker than this share of the strongest are those of rounding, not of the field [-]."""


@dataclass(frozen=True)
class Pod:
    """A field's mean and modes; unit of the field.

    Parameters
    ----------
    modes
        Orthonormal, the strongest first [-].
    coefficients
        Of the cases that it was made from.
    rest
        What the modes leave at each node: root mean square length over the cases.
    """

    mean: Float[np.ndarray, "nodes components"]
    modes: Float[np.ndarray, "modes nodes components"]
    coefficients: Float[np.ndarray, "cases modes"]
    rest: Float[np.ndarray, " nodes"]

    @property
    def spread(self) -> Float[np.ndarray, " modes"]:
        """Root mean square of each coefficient over the cases."""
        return np.sqrt(np.mean(self.coefficients**2, axis=0))

    def fields(self, coefficients: Float[np.ndarray, "asked modes"]) -> Float[np.ndarray, "asked nodes components"]:
        """The fields of these coefficients."""
        return self.mean + np.tensordot(coefficients, self.modes, axes=1)


def pod_of(values: Float[np.ndarray, "cases nodes components"], most: int) -> Pod:
    """Modes of some cases: `most` of them, or as many as the cases have."""
    mean = values.mean(axis=0, dtype=np.float64)
    centred = (values - mean).reshape(len(values), -1)
    first = max(0, len(values) - most)
    squares, vectors = eigh(centred @ centred.T, subset_by_index=[first, len(values) - 1])
    strengths = np.sqrt(squares[::-1].clip(0))
    kept = int(np.count_nonzero(strengths > NOISE * strengths[0]))
    coefficients = vectors[:, ::-1][:, :kept] * strengths[:kept]
    modes = (vectors[:, ::-1][:, :kept] / strengths[:kept]).T @ centred
    rest = (centred - coefficients @ modes).reshape(values.shape)
    return Pod(
        mean,
        modes.reshape(kept, *mean.shape),
        coefficients,
        np.sqrt(np.mean(np.sum(rest**2, axis=-1), axis=0)),
    )
