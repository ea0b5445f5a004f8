r"""Modes as rows of numbers of one kind: the field is the mean plus a sum of rows, each times an amount.

In float a row is a mode. In int8 a row is a mode over its scale, rounded; where the rounding of a mode moves the field
too far, another row holds what is left of it, over a scale of its own:

    φ_k ≈ s₁ q₁ + s₂ q₂ + ...,    q in -127 ... 127

The scales are put into the weights of the amounts, so that both kinds are evaluated by the same code.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.inference.low_rank import LowRankField

LARGEST = 127
MOST_ROWS = 3
"""Of a mode, at most: then what is left is as small as in single precision."""
FLOAT_BYTES = 4
SMALLEST = 1e-30


@dataclass(frozen=True)
class Layers:
    """A field's mean, rows, and the weights of their amounts.

    Parameters
    ----------
    rows
        In float32, or in int8.
    mode, scale
        Of each row: its amount is that of this mode times this number.
    weights
        Of the products of Chebyshev polynomials in each row's amount.
    degrees
        Highest degree along x and along u.
    components
        Of the field at a node.
    """

    mean: Float[np.ndarray, " values"]
    rows: np.ndarray
    mode: Int[np.ndarray, " rows"]
    scale: Float[np.ndarray, " rows"]
    weights: Float[np.ndarray, "terms rows"]
    degrees: tuple[int, int]
    components: int

    def values(self, amounts: Float[np.ndarray, "asked modes"]) -> Float[np.ndarray, "asked nodes components"]:
        """The field of these amounts of the modes, as C gets it."""
        flat = self.mean + (amounts[:, self.mode] * self.scale) @ self.rows
        return flat.reshape(len(amounts), -1, self.components)

    @property
    def bytes(self) -> int:
        """Of the constant arrays in C."""
        return self.rows.nbytes + FLOAT_BYTES * (self.mean.size + self.weights.size)


def in_float(field: LowRankField) -> Layers:
    """Each mode as it is, in single precision."""
    rows = field.modes.reshape(len(field.modes), -1).astype(np.float32)
    return _layers(field, rows, np.arange(len(rows)), np.ones(len(rows)))


def in_int8(field: LowRankField, rows_of: list[int]) -> Layers:
    """Mode k as that many rows."""
    rows, scales = [], []
    for k, count in enumerate(rows_of):
        left = field.modes[k].ravel()
        for _ in range(count):
            scale = max(float(np.abs(left).max()), SMALLEST) / LARGEST
            row = np.round(left / scale)
            left = left - scale * row
            rows.append(row.astype(np.int8))
            scales.append(scale)
    return _layers(field, np.array(rows), np.repeat(np.arange(len(rows_of)), rows_of), np.array(scales))


def _layers(field: LowRankField, rows: np.ndarray, mode: np.ndarray, scale: np.ndarray) -> Layers:
    weights = field.weights[:, mode] * scale
    return Layers(field.mean.ravel(), rows, mode, scale, weights, field.degrees, field.components)


def roundings(
    field: LowRankField, rows_of: list[int], amounts: Float[np.ndarray, "asked modes"]
) -> Float[np.ndarray, " modes"]:
    """How far the rounding of each mode moves a value of the field, at most."""
    found = []
    for k, count in enumerate(rows_of):
        scale = np.abs(field.modes[k]).max() / LARGEST / (2 * LARGEST) ** (count - 1)
        found.append(scale / 2 * np.abs(amounts[:, k]).max())
    return np.array(found)
