"""Errors of predicted node positions, in mm.

Error of a node in a pair: e = |predicted - true| (Euclidean). Over all nodes of all pairs

    mean = <e>    rmse = sqrt <e²>    p95 = 95th percentile    max    relative = <e> / <|true - initial|>

so that predicting no movement at all has relative 1 by definition, whatever the data. Nothing here depends on where the
muscle is: a rigid motion of everything changes no figure.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

from myograph.ensemble.predictor import Predictor
from myograph.errors import InputError


@dataclass(frozen=True)
class ErrorSummary:
    """Errors of a method under a protocol [mm]; `relative` is the mean over the mean displacement [-]."""

    mean_mm: float
    rmse_mm: float
    p95_mm: float
    max_mm: float
    relative: float


@dataclass(frozen=True)
class NodeErrors:
    """Error of every node in every pair.

    Parameters
    ----------
    errors
        Distance of prediction and truth [mm]; single precision, for a thousand pairs of four thousand nodes are 16 MB.
    mean_displacement
        Mean distance from initial to true position [mm].
    """

    errors: Float32[np.ndarray, "pairs nodes"]
    mean_displacement: float

    @property
    def node_mean(self) -> Float32[np.ndarray, " nodes"]:
        """Mean error of each node over the pairs [mm], for a heat map."""
        return self.errors.mean(axis=0)

    def summary(self) -> ErrorSummary:
        """The five figures; raises InputError where nothing moves, for then no error can be relative."""
        if not self.mean_displacement > 0:
            raise InputError(
                f"relative error: expected nodes that move, got a mean displacement of {self.mean_displacement} mm; "
                "leave pairs of a case with itself aside"
            )
        mean = float(self.errors.mean(dtype=np.float64))
        return ErrorSummary(
            mean_mm=mean,
            rmse_mm=float(np.sqrt(np.mean(np.square(self.errors), dtype=np.float64))),
            p95_mm=float(np.percentile(self.errors, 95)),
            max_mm=float(self.errors.max()),
            relative=mean / self.mean_displacement,
        )


Samples = tuple[
    Float[np.ndarray, "batch sensors 6"], Float[np.ndarray, "batch queries 3"], Float[np.ndarray, "batch queries 3"]
]
"""Of some pairs [mm]: (S, T) at the sensors, S at the queries, T at the queries."""


def evaluate(predictor: Predictor, batches: Iterable[Samples]) -> NodeErrors:
    """Errors of a predictor over batches of (sensors, queries, targets); holds one batch of positions at a time.

    The queries must be the same nodes in all batches.
    """
    errors: list[np.ndarray] = []
    displacement = 0.0
    for sensors, queries, targets in batches:
        errors.append(node_errors(predictor.predict(sensors, queries), targets))
        displacement += float(node_errors(queries, targets).sum(dtype=np.float64))
        if errors[-1].shape[1] != errors[0].shape[1]:
            raise InputError(f"expected {errors[0].shape[1]} queries in every batch, got {errors[-1].shape[1]}")
    if not sum(map(len, errors)):
        raise InputError("expected at least one pair to evaluate, got none: is the test split empty?")
    gathered = np.concatenate(errors)
    return NodeErrors(gathered, displacement / gathered.size)


def summarise(
    predicted: Float[np.ndarray, "batch nodes 3"],
    true: Float[np.ndarray, "true_batch true_nodes 3"],
    initial: Float[np.ndarray, "initial_batch initial_nodes 3"],
) -> ErrorSummary:
    """Errors of positions [mm] that are all at hand; the three shapes must be equal."""
    displacement = node_errors(initial, true)
    return NodeErrors(node_errors(predicted, true), float(displacement.mean(dtype=np.float64))).summary()


def node_errors(
    predicted: Float[np.ndarray, "batch nodes 3"], true: Float[np.ndarray, "true_batch true_nodes 3"]
) -> Float32[np.ndarray, "batch nodes"]:
    """Distance of each node from its true position [mm]; raises InputError for shapes that differ, and for NaN."""
    if predicted.shape != true.shape:
        raise InputError(f"expected predictions of shape {true.shape} as the true positions, got {predicted.shape}")
    for name, positions in (("predicted", predicted), ("true", true)):
        bad = int(np.count_nonzero(~np.isfinite(positions)))
        if bad:
            raise InputError(
                f"{name} positions: expected finite numbers, got {bad} of {positions.size} NaN or infinite"
            )
    return np.linalg.norm(predicted - true, axis=-1).astype(np.float32)
