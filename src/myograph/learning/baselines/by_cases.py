"""Training of a module that answers from the target case alone: batches of cases, not of pairs.

Loss: mean over the fields of the squared error over the field's own spread, so that mm and MPa weigh alike.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor, nn

from myograph.ensemble.pairs.predictor import Progress
from myograph.errors import InputError
from myograph.learning.baselines.taught import Taught
from myograph.learning.training import History, TrainingConfig, train
from myograph.learning.training.drawing import share_of
from myograph.learning.training.trainable import device_of

Arguments = Callable[[Int[np.ndarray, " cases"], Int[np.ndarray, " queries"]], Sequence[Tensor]]
"""What the module is given for some of the taught cases, asked at these nodes."""


@dataclass(frozen=True)
class Training:
    """How to train: see `myograph.learning.training.train`."""

    config: TrainingConfig
    progress: Progress | None
    folder: Path | None
    about: str


@final
@dataclass
class CaseTraining:
    """A `myograph.learning.training.Trainable`.

    Parameters
    ----------
    module
        Takes `arguments`, gives the taught fields in their order.
    nodes
        Of the body, where the module can be asked.
    learned, validated
        Taught cases to learn from, and to validate on: none where empty.
    spread
        Of each field: root mean square distance from its node's mean.
    """

    module: nn.Module
    taught: Taught
    arguments: Arguments
    nodes: Int[np.ndarray, " nodes"]
    config: TrainingConfig
    learned: Int[np.ndarray, " learned"]
    validated: Int[np.ndarray, " validated"]
    spread: Mapping[str, float]

    def parameter_groups(self, rate: float) -> list[dict[str, Any]]:
        """All parameters alike."""
        return [{"params": list(self.module.parameters()), "lr": rate}]

    def loss(self, generator: np.random.Generator) -> tuple[Float[Tensor, ""], float]:
        """Of cases at random, at nodes at random."""
        cases = share_of(generator.choice(self.learned, size=self.config.batch))
        queries = np.sort(generator.choice(self.nodes, min(self.config.queries, len(self.nodes)), replace=False))
        squares = self._squares(cases, queries)
        losses = [square.mean() / self.spread[name] ** 2 for name, square in squares.items()]
        return torch.stack(losses).mean(), float(_leading(squares).detach().mean().sqrt())

    def validation_mm(self) -> float | None:
        """Mean distance over the held-out cases and all nodes."""
        if not len(self.validated):
            return None
        return float(_leading(self._squares(self.validated, self.nodes)).sqrt().mean())

    def after_step(self, step: int) -> None:
        """Nothing is due."""

    def _squares(self, cases: Int[np.ndarray, " cases"], queries: Int[np.ndarray, " queries"]) -> dict[str, Tensor]:
        """Field -> squared length of the error at every query."""
        device = device_of(self.module)
        answers = self.module(*(argument.to(device) for argument in self.arguments(cases, queries)))
        squares = {}
        for (name, values), answer in zip(self.taught.fields.items(), answers, strict=True):
            truth = torch.from_numpy(np.asarray(values[np.ix_(cases, queries)], dtype=np.float32)).to(device)
            squares[name] = (answer.view(truth.shape) - truth).square().sum(dim=-1)
        return squares


def train_by_cases(
    module: nn.Module, taught: Taught, arguments: Arguments, nodes: Int[np.ndarray, " nodes"], how: Training
) -> History:
    """Train the module in place; it is asked at `nodes` only. Raises InputError for patience without validation."""
    count = round(how.config.validation * len(taught))
    if how.config.patience is not None and not count:
        raise InputError(
            f"patience: expected cases to validate on, got none of {len(taught)}; set a larger 'validation'"
        )
    shuffled = np.random.default_rng((how.config.seed, 1)).permutation(len(taught))
    learned, validated = np.sort(shuffled[count:]), np.sort(shuffled[:count])
    spread = {name: spread_of(values) for name, values in taught.fields.items()}
    trainable = CaseTraining(module, taught, arguments, nodes, how.config, learned, validated, spread)
    return train(trainable, how.config, how.progress, how.folder, how.about)


def spread_of(values: Float[np.ndarray, "cases nodes components"]) -> float:
    """Root mean square distance of a field from its node's mean; 1 where nothing varies."""
    return float(np.sqrt(np.var(values, axis=0, dtype=np.float64).sum(axis=-1).mean())) or 1.0


def _leading(squares: dict[str, Tensor]) -> Tensor:
    """Those of the position, or of the first field where it is not asked."""
    return squares.get("position", next(iter(squares.values())))
