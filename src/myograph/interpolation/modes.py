r"""Few modes for many numbers: data of several states as a mean and a short combination of vectors.

values_s ≈ mean + Σ_k c_sk v_k. With weights w the vectors are orthonormal, Σ_n w_n v_kn v_jn = δ_kj, and for every r
the first r leave the least weighted sum of squares. r is the smallest number whose largest error is within the
tolerance.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError


@dataclass(frozen=True, eq=False)
class Modes:
    """Mean, vectors and coefficients of compressed data.

    Parameters
    ----------
    mean, vectors, coefficients
        In short: values ≈ mean + coefficients @ vectors, in the data's unit.
    largest_error
        Largest error of an entry over all states, in the data's unit.
    """

    mean: Float[np.ndarray, " n"]
    vectors: Float[np.ndarray, "modes n"]
    coefficients: Float[np.ndarray, "states modes"]
    largest_error: float

    def expand(self, coefficients: Float[np.ndarray, "*batch modes"]) -> Float[np.ndarray, "*batch n"]:
        """Data of any coefficients, those of the states or interpolated ones."""
        return self.mean + coefficients.astype(self.vectors.dtype) @ self.vectors

    def rounded(self) -> "Modes":
        """With vectors in single precision: twice as fast to expand, for reading them is what takes the time."""
        return replace(self, vectors=self.vectors.astype(np.float32))


def compress(
    values: Float[np.ndarray, "states n"], tolerance: float, weights: Float[np.ndarray, " weights"] | None = None
) -> Modes:
    """The fewest modes that give every entry of every state within the tolerance.

    Parameters
    ----------
    tolerance
        Largest error of an entry, in the data's unit.
    weights
        (n,), positive; how much an entry counts in the sum of squares that the modes make small. None: all alike.

    Raises InputError for data or weights that are not finite or of the wrong shape, and for a tolerance that rounding
    does not allow.
    """
    scale = np.sqrt(_checked(values, weights))
    mean = values.mean(axis=0)
    rest = values - mean
    left, sizes, right = np.linalg.svd(rest * scale, full_matrices=False)
    coefficients, vectors = left * sizes, right / scale
    modes, error = 0, float(np.abs(rest).max())
    while not error <= tolerance:
        if modes == len(sizes):
            raise InputError(f"expected a tolerance above the rounding error {error:g}, got {tolerance:g}")
        rest -= np.outer(coefficients[:, modes], vectors[modes])
        modes, error = modes + 1, float(np.abs(rest).max())
    return Modes(mean, vectors[:modes].copy(), coefficients[:, :modes].copy(), error)


def _checked(values: np.ndarray, weights: np.ndarray | None) -> np.ndarray:
    """The weights, or ones; refuse what cannot be compressed."""
    if values.ndim != 2 or not values.size:
        raise InputError(f"expected data of shape (states, n), got {values.shape}")
    finite = np.isfinite(values).all(axis=1)
    if not finite.all():
        raise InputError(
            f"expected finite data, got {np.count_nonzero(~finite)} states that are not, "
            f"the first is state {np.flatnonzero(~finite)[0]}"
        )
    if weights is None:
        return np.ones(values.shape[1])
    if weights.shape != values.shape[1:]:
        raise InputError(f"expected {values.shape[1]} weights, got {len(weights)}")
    positive = np.isfinite(weights) & (weights > 0)
    if not positive.all():
        raise InputError(f"expected finite positive weights, got {weights[~positive][0]:g}")
    return weights
