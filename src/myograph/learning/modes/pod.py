"""Proper orthogonal modes of a field at the nodes, from snapshots.

    values_i = mean + sum_k c_ik φ_k,  φ_j · φ_k = δ_jk

The φ_k are the leading eigenvectors of the covariance of the values, got from the products of snapshots with each
other; no other modes of that number leave a smaller sum of squares. Source: Sirovich 1987.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.linalg import eigh

from myograph.errors import InputError

SMALLEST = 1e-13
"""A mode's share of the sum of squares below which it is rounding of single precision."""
VALUES_AT_ONCE = 2**13


@dataclass(frozen=True)
class Pod:
    """Mean, orthonormal modes, and how much of each is in every snapshot, all in the unit of the field."""

    mean: Float[np.ndarray, " values"]
    modes: Float[np.ndarray, "modes values"]
    amounts: Float[np.ndarray, "cases modes"]

    @property
    def spread(self) -> Float[np.ndarray, " modes"]:
        """Root mean square of each mode's amounts."""
        return np.sqrt(np.square(self.amounts).mean(axis=0))


def proper_modes(values: Float[np.ndarray, "cases values"], count: int) -> Pod:
    """At most that many modes: as many as there are above rounding.

    Raises InputError for fewer than two snapshots, or snapshots that are all the same.
    """
    if len(values) < 2:
        raise InputError(f"modes: expected at least 2 cases, got {len(values)}")
    mean = values.mean(axis=0, dtype=np.float64)
    products = np.zeros((len(values), len(values)))
    for part in _parts(values.shape[1]):
        deviation = values[:, part] - mean[part]
        products += deviation @ deviation.T
    total = float(np.trace(products))
    if not total > 0:
        raise InputError("modes: expected cases that differ, got the same values in all")
    kept = min(count, len(values) - 1)
    squares, vectors = eigh(products, subset_by_index=(len(values) - kept, len(values) - 1))
    above = (squares > SMALLEST * total)[::-1]
    squares, vectors = squares[::-1][above], vectors[:, ::-1][:, above]
    modes = np.empty((len(squares), values.shape[1]))
    for part in _parts(values.shape[1]):
        modes[:, part] = vectors.T @ (values[:, part] - mean[part]) / np.sqrt(squares)[:, None]
    return Pod(mean, modes, vectors * np.sqrt(squares))


def _parts(values: int) -> list[slice]:
    return [slice(first, first + VALUES_AT_ONCE) for first in range(0, values, VALUES_AT_ONCE)]
