"""A graph element network with all it needs to be used on a muscle: millimetres in, millimetres out."""

from dataclasses import dataclass

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor

from myograph.ensemble.pairs import Batch, Source
from myograph.errors import InputError
from myograph.learning.config import TrainingConfig
from myograph.learning.network import GraphElementNetwork
from myograph.learning.samples import check_samples
from myograph.learning.scaling import Scaling

VALUES = 3
"""Numbers at a sensor beside its position, and at a query: a vector of space."""
SAMPLES_AT_ONCE = 16


@dataclass(frozen=True)
class TrainingRecord:
    """What happened in training.

    Parameters
    ----------
    config
        How it was meant to go.
    rmse
        Root mean square distance of answer and truth over the queries of each step [mm].
    seconds
        Wall time [s].
    nodes_before, nodes_after
        Positions of the graph's nodes [mm].
    """

    config: TrainingConfig
    rmse: Float[np.ndarray, " steps"]
    seconds: float
    nodes_before: Float[np.ndarray, "nodes 3"]
    nodes_after: Float[np.ndarray, "nodes 3"]


@dataclass(frozen=True)
class Gen:
    """A trained network; a `myograph.ensemble.predictor.Predictor`.

    Parameters
    ----------
    sensors
        Indices of the dataset's nodes that were its sensors.
    source
        Of the training data.
    protocol
        Whose training pairs it learned from.
    """

    network: GraphElementNetwork
    scaling: Scaling
    sensors: Int[np.ndarray, " sensors"]
    source: Source
    protocol: str
    record: TrainingRecord

    @property
    def name(self) -> str:
        """Such as gen_343."""
        return f"gen_{len(self.network.nodes)}"

    def predict(
        self, sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"]
    ) -> Float[np.ndarray, "batch queries 3"]:
        """Positions T [mm] of the points that sit at `queries` [mm]; `sensors` are (S, T) [mm]."""
        check_samples(sensors, queries)
        trained = len(self.sensors)
        if self.network.config.aggregation == "sum" and sensors.shape[1] != trained:
            raise InputError(
                f"expected {trained} sensors, as in training, got {sensors.shape[1]}; train with that many"
            )
        answers = np.empty(queries.shape)
        with torch.no_grad():
            for first in range(0, len(queries), SAMPLES_AT_ONCE):
                part = slice(first, first + SAMPLES_AT_ONCE)
                values = answer(self.network, self.scaling, sensors[part], queries[part]).double().numpy()
                answers[part] = self.scaling.targets(queries[part], values)
        return answers


def answer(
    network: GraphElementNetwork,
    scaling: Scaling,
    sensors: Float[np.ndarray, "batch sensors 6"],
    queries: Float[np.ndarray, "batch queries 3"],
) -> Float[Tensor, "batch queries 3"]:
    """Values [-] that the network gives the queries; arguments in mm."""
    initial, target = sensors[..., :3], sensors[..., 3:]
    inputs = scaling.into_box(initial), scaling.values(initial, target), scaling.into_box(queries)
    return network(*(torch.tensor(array, dtype=torch.float32) for array in inputs))


def mean_squared_error(network: GraphElementNetwork, scaling: Scaling, batch: Batch) -> Float[Tensor, ""]:
    """Loss: mean over samples, queries and components of the squared error of the values [-]."""
    wanted = torch.tensor(scaling.values(batch.queries, batch.targets), dtype=torch.float32)
    return (answer(network, scaling, batch.sensors, batch.queries) - wanted).square().mean()
