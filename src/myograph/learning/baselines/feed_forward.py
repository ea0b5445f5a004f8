"""The thesis's feed-forward network as a method that learns: see `node_network`."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import final

import numpy as np
import torch

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.signature import Signature
from myograph.learning.baselines.by_cases import Training, train_by_cases
from myograph.learning.baselines.node_network import FeedForwardConfig, FeedForwardShape, NodeNetwork
from myograph.learning.baselines.taught import taught
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.training import TrainingConfig
from myograph.learning.training.about import about

FEED_FORWARD_TRAINING = TrainingConfig(steps=2000, batch=32, queries=4096, learning_rate=2e-3)
"""All nodes of a body of 4,027 in every step."""


@final
@dataclass(frozen=True)
class FeedForward:
    """A `myograph.ensemble.pairs.predictor.Learner`: the method before it has seen data.

    Parameters
    ----------
    folder
        Where the training writes its checkpoints and logs; nothing is written without it.
    """

    network: FeedForwardConfig = field(default_factory=FeedForwardConfig)
    training: TrainingConfig = FEED_FORWARD_TRAINING
    folder: Path | None = None
    name: str = "feed_forward"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Train on the target cases of the training pairs."""
        told, body = taught(sampler, split), sampler.cases.body
        answered = np.unique(body.skin) if self.network.surface_only else np.arange(sampler.cases.nodes)
        shape = FeedForwardShape(
            **self.network.model_dump(),
            fields=tuple(told.fields),
            muscles=told.activation.shape[1],
            body_nodes=sampler.cases.nodes,
            answered_nodes=len(answered),
        )
        module = NodeNetwork(shape, self.training.seed)
        module.fit_scaling(told, answered)
        activation = torch.from_numpy(told.activation.astype(np.float32))
        train_by_cases(
            module,
            told,
            lambda cases, queries: (activation[cases], torch.from_numpy(queries)),
            answered,
            Training(self.training, progress, self.folder, about(sampler, split, shape.model_dump_json())),
        )
        signature = Signature(inputs=("activation", "query_nodes"), outputs=shape.fields, convention=sampler.convention)
        return TorchPredictor(self.name, "feed_forward", module, signature, shape)
