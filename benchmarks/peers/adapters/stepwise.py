"""What the torch peers share: scaled targets, Adam with a one-cycle rate over a time limit, answers back in mm.

The limit counts the processor's seconds of one thread, so that a busy machine takes nothing from them. What Adam
imports when it is first made is imported before.
"""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import torch
import torch._dynamo
from torch import Tensor, nn

BATCH, RATE = 16, 2e-3


class Answering:
    """A trained module as what predicts: forward(activation batch) -> (batch, nodes, 4), scaled."""

    steps = 0.0

    def __init__(self, module: nn.Module, forward: Callable[[Tensor], Tensor], mean: Any, spread: Any) -> None:
        self.module, self.forward, self.mean, self.spread = module, forward, mean, spread
        self.numbers = sum(parameter.numel() for parameter in module.parameters())

    def __call__(self, activation: np.ndarray) -> dict[str, np.ndarray]:
        """Position [mm] and von Mises stress [MPa] at all nodes."""
        given = torch.from_numpy(activation.astype(np.float32))
        with torch.no_grad():
            parts = [self.forward(own).numpy() for own in given.split(BATCH)]
        values = np.concatenate(parts) * self.spread + self.mean
        return {"position": values[..., :3], "von_mises": values[..., 3]}


def train(module: nn.Module, forward: Callable[[Tensor], Tensor], task: Any) -> Answering:
    """Mean squared error of scaled values, until the time is over."""
    torch.manual_seed(task.seed)
    values = np.concatenate([task.position, task.von_mises[..., None]], axis=-1)
    mean = values.mean(axis=0)
    left = values - mean
    spread = np.sqrt(np.array([*[np.square(left[..., :3]).mean()] * 3, np.square(left[..., 3]).mean()]))
    wanted = torch.from_numpy((left / spread).astype(np.float32))
    given = torch.from_numpy(task.activation.astype(np.float32))
    optimiser = torch.optim.Adam(module.parameters(), lr=RATE)
    trained = Answering(module, forward, mean, spread)
    draw = np.random.default_rng(task.seed)
    for share in shares(task.started, task.seconds):
        rate = RATE * (share / 0.2 if share < 0.2 else 0.5 + 0.5 * math.cos(math.pi * (share - 0.2) / 0.8))
        for group in optimiser.param_groups:
            group["lr"] = max(rate, 1e-6)
        some = torch.from_numpy(draw.integers(len(given), size=BATCH))
        loss = (forward(given[some]) - wanted[some]).square().mean()
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        trained.steps += 1
    module.eval()
    return trained


def shares(started: float, seconds: float) -> Iterator[float]:
    """Share of the time that is over, before each step; none before a step as long as the last would end too late."""
    now, step = time.process_time(), 0.0
    while now + step < started + seconds:
        yield (now - started) / seconds
        step, now = time.process_time() - now, time.process_time()


def places(task: Any) -> Tensor:
    """Nodes of the reference body over its half length."""
    reference = task.reference - task.reference.mean(axis=0)
    return torch.from_numpy((reference / np.abs(reference).max()).astype(np.float32))
