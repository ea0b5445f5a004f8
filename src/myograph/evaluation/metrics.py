"""Errors of what methods answer: of positions in mm, of von Mises stress in MPa.

Error of a node in a pair: e = |predicted - true| (Euclidean for positions). Over all nodes of all pairs

    mean = <e>    rmse = sqrt <e²>    p95 = 95th percentile    max    relative = <e> / scale

The scale of positions is the mean displacement <|true - initial|>, so that predicting no movement at all has relative
1 by definition, whatever the data; that of von Mises stress is its mean. coverage_90 is the share of errors within the
half width of the 90 % interval that the method gives. Nothing here depends on where the muscle is: a rigid motion of
everything changes no figure.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

from myograph.errors import InputError


@dataclass(frozen=True)
class NodeErrors:
    """Error of every node in every pair, in one field.

    Parameters
    ----------
    errors
        Of each node [mm] or [MPa]; single precision, for a thousand pairs of four thousand nodes are 16 MB.
    scale
        What errors are relative to [mm] or [MPa]: the mean displacement, the mean stress.
    coverage_90
        Share of errors within the method's 90 % interval, where it gives one.
    """

    errors: Float32[np.ndarray, "pairs nodes"]
    scale: float
    coverage_90: float | None = None

    @property
    def node_mean(self) -> Float32[np.ndarray, " nodes"]:
        """Mean error of each node over the pairs, for a heat map."""
        return self.errors.mean(axis=0)

    @property
    def mean(self) -> float:
        """Mean error."""
        return float(self.errors.mean(dtype=np.float64))

    @property
    def rmse(self) -> float:
        """Root of the mean squared error."""
        return float(np.sqrt(np.mean(np.square(self.errors), dtype=np.float64)))

    @property
    def p95(self) -> float:
        """95th percentile of the errors."""
        return float(np.percentile(self.errors, 95))

    @property
    def largest(self) -> float:
        """Largest error."""
        return float(self.errors.max())

    @property
    def relative(self) -> float:
        """Mean error over the scale [-]; raises InputError where the scale is zero."""
        if not self.scale > 0:
            raise InputError(
                f"relative error: expected nodes that move and are stressed, got a mean of {self.scale}; "
                "leave pairs of a case with itself aside"
            )
        return self.mean / self.scale


def node_errors(
    predicted: Float[np.ndarray, "batch nodes 3"], true: Float[np.ndarray, "true_batch true_nodes 3"]
) -> Float32[np.ndarray, "batch nodes"]:
    """Distance of each node from its true position [mm]; raises InputError for shapes that differ, and for NaN."""
    _check("positions", predicted, true)
    return np.linalg.norm(predicted - true, axis=-1).astype(np.float32)


def stress_errors(
    predicted: Float[np.ndarray, "batch nodes"], true: Float[np.ndarray, "true_batch true_nodes"]
) -> Float32[np.ndarray, "batch nodes"]:
    """Absolute error of each node's stress [MPa]; raises InputError for shapes that differ, and for NaN."""
    _check("stresses", predicted, true)
    return np.abs(predicted - true).astype(np.float32)


def _check(what: str, predicted: np.ndarray, true: np.ndarray) -> None:
    if predicted.shape != true.shape:
        raise InputError(f"expected predictions of shape {true.shape} as the true {what}, got {predicted.shape}")
    for name, values in (("predicted", predicted), ("true", true)):
        bad = int(np.count_nonzero(~np.isfinite(values)))
        if bad:
            raise InputError(f"{name} {what}: expected finite numbers, got {bad} of {values.size} NaN or infinite")
