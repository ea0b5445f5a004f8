"""What the training loop needs to train a graph element network on pairs of cases.

Loss: mean over samples, queries and numbers of the squared error of the scaled features, and the terms of physics.
The processor's weights work once in every round, so that their rate is divided by the number of rounds: without that,
many rounds of one layer lose what the sensors said. Source: thesis section 5.4 for a rate of the nodes' own.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from jaxtyping import Float, Int
from scipy.spatial import Delaunay
from torch import Tensor, nn

from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.question import Batch, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.feeds import feeds
from myograph.learning.gen.muscle import MuscleGen
from myograph.learning.physics.terms import Asking, PhysicsTerms
from myograph.learning.training.config import TrainingConfig
from myograph.learning.training.drawing import draw_batch, share_of
from myograph.learning.training.trainable import device_of

VALIDATED = 64
"""Pairs, at most, that a validation looks at."""

Parts = dict[str, Tensor]


@dataclass(frozen=True)
class GenTrainable:
    """A `myograph.learning.training.Trainable`.

    Parameters
    ----------
    pairs, validated
        Pairs that teach; pairs that are held out, none where there is no validation.
    physics
        What is minded beside the cases, if anything.
    """

    module: MuscleGen
    sampler: PairSampler
    pairs: PairSet
    validated: PairSet
    config: TrainingConfig
    physics: PhysicsTerms | None = None

    def compiled(self) -> nn.Module:
        """The network: the module around it is asked for scaled values by a method of its own."""
        return self.module.network

    def parameter_groups(self, rate: float) -> list[dict[str, Any]]:
        """Weights, the processor's weights, and what neither decays nor is a weight: sharpness and node positions."""
        network = self.module.network
        processor = [*network.processor.parameters(), *network.norm.parameters()]
        apart = {id(parameter) for parameter in (*processor, network.nodes, network.log_sharpness)}
        weights = [parameter for parameter in network.parameters() if id(parameter) not in apart]
        groups = [
            {"params": weights, "lr": rate},
            {"params": processor, "lr": rate / network.config.message_rounds},
            {"params": [network.nodes], "lr": self.config.node_learning_rate, "weight_decay": 0.0},
        ]
        if network.log_sharpness.requires_grad:
            groups.append({"params": [network.log_sharpness], "lr": rate, "weight_decay": 0.0})
        return groups

    def loss(self, generator: np.random.Generator) -> tuple[Float[Tensor, ""], float]:
        """Mean squared error of the scaled features [-]; root mean square error in mm, or MPa without positions."""
        batch = draw_batch(self.sampler, self.pairs, self.config, generator)
        parts, truth = self.tensors(batch)
        parts = self._forget(parts, generator)
        module = self.module
        wanted = module.wanted(parts, truth)
        error = module.scaled(parts) - wanted
        loss, rmse = error.square().mean(), self._rmse(error.detach(), wanted, parts)
        if self.physics is not None:
            pairs = share_of(self.pairs.draw(generator, self.config.batch))
            loss = loss + self.physics.loss(Asking(self.parts, self.positions), pairs, generator)
        return loss, rmse

    def validation_mm(self) -> float | None:
        """Mean distance [mm], or mean error of the first field, over some held-out pairs at all queries."""
        if not len(self.validated):
            return None
        pairs = self.validated.draw(np.random.default_rng(self.config.seed), VALIDATED)
        errors = []
        for batch in self.sampler.batches(pairs, size=self.config.batch):
            parts, truth = self.tensors(batch)
            name = self.module.outputs[0]
            answer = self.module(*(parts[part] for part in self.module.inputs))[0]
            errors.append(_distance(answer - truth[name], name).mean().item() * len(batch.question.activation))
        return sum(errors) / len(pairs)

    def after_step(self, step: int) -> None:
        """Join the nodes anew, now and then."""
        if step % self.config.triangulate_every == 0:
            self.module.network.triangulate()

    def mesh(self) -> tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "triangles 3"]]:
        """Nodes [mm] and the triangles around them."""
        triangulation = self.module.network.graph.triangulation
        assert isinstance(triangulation, Delaunay)
        return self.module.nodes_mm, triangulation.convex_hull.astype(np.int64)

    def tensors(self, batch: Batch) -> tuple[Parts, Parts]:
        """Parts of the question and the right fields, where the module is."""
        device, right = device_of(self.module), batch.truth
        truth = {name: torch.from_numpy(np.asarray(values, np.float32)).to(device) for name, values in right.items()}
        return self.parts(batch.question), truth

    def parts(self, question: Question) -> Parts:
        """Parts of the question that the module reads, where it is."""
        device = device_of(self.module)
        return {name: torch.from_numpy(array).to(device) for name, array in feeds(question, self.module.inputs).items()}

    def positions(self, parts: Parts) -> Float[Tensor, "batch queries 3"]:
        """Positions that the module answers [mm]."""
        module = self.module
        return module.fields_of(module.scaled(parts), parts)[module.outputs.index("position")]

    def _forget(self, parts: Parts, generator: np.random.Generator) -> Parts:
        """Leave out sensors, or activations, at random: so one network learns to answer from either."""
        if "activation" not in parts or "sensor_places" not in parts:
            return parts
        share, sensors = self.module.config.dropout, parts["sensor_places"].shape[1]
        if generator.random() < share:
            return {name: part[:, :0] if name.startswith("sensor_") else part for name, part in parts.items()}
        forgotten = torch.from_numpy(share_of(generator.random(self.config.batch)) < share)
        forgotten = forgotten.to(parts["activation"].device)
        activation = parts["activation"].masked_fill(forgotten[:, None], torch.nan)
        if self.module.config.aggregation == "mean":
            kept = torch.from_numpy(generator.permutation(sensors)[: generator.integers(1, sensors + 1)])
            parts = {
                name: part[:, kept.to(part.device)] if name.startswith("sensor_") else part
                for name, part in parts.items()
            }
        return {**parts, "activation": activation}

    def _rmse(self, error: Tensor, wanted: Tensor, parts: Parts) -> float:
        """Of the first field, from scaled errors."""
        module = self.module
        right, given = (module.fields_of(scaled, parts)[0] for scaled in (wanted, wanted + error))
        return _distance(given - right, module.outputs[0]).square().mean().sqrt().item()


def _distance(error: Tensor, field: str) -> Tensor:
    return error.abs() if field == "von_mises" else torch.linalg.vector_norm(error, dim=-1)
