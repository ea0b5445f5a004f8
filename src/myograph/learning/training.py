"""Training of a graph element network on pairs of cases.

Adam for the weights and another for the positions of the graph's nodes, both with a one-cycle rate: up in a line, down
in a cosine. The processor's weights work once in every round, so that their rate is divided by the number of rounds:
without that, many rounds of one layer lose what the sensors said.
Same seed, same losses, on one machine and one number of threads.
Sources: thesis section 5.4 for the two optimisers; Smith & Topin 2018 for the one-cycle rate.
"""

import math
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import torch
from jaxtyping import Float

from myograph.ensemble.pairs import PairSampler
from myograph.ensemble.protocols import Split
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.gen import VALUES, Gen, TrainingRecord, mean_squared_error
from myograph.learning.network import GraphElementNetwork
from myograph.learning.scalars import ScalarLog
from myograph.learning.scaling import Scaling, fit_scaling

Progress = Callable[[int, int, float], None]
"""Called after each step with its number from 1, the number of steps, and the step's root mean square error [mm]."""

RISE = 0.2
"""Share of the training in which the rates go up."""
BETAS = (0.9, 0.95)
"""Memory of Adam; that of the gradients' size is short, as the training is."""


def train_gen(
    sampler: PairSampler,
    split: Split,
    network_config: NetworkConfig,
    training: TrainingConfig,
    progress: Progress | None = None,
    log_to: Path | None = None,
) -> Gen:
    """Train on the split's training pairs; nothing of its other cases is looked at.

    Parameters
    ----------
    log_to
        Folder for TensorBoard's scalars; none are written without it.
    """
    started = time.perf_counter()
    scaling = fit_scaling(sampler.positions, split.train, network_config.target)
    network = GraphElementNetwork(network_config, scaling.unit_sides, VALUES, VALUES, training.seed)
    nodes_before = _nodes_in_mm(network, scaling)
    optimisers = _optimisers(network, training)
    draw = np.random.default_rng(training.seed)
    asked = min(training.queries, len(sampler.queries))
    rmse: list[float] = []
    with ScalarLog(log_to) as log:
        for step in range(1, training.steps + 1):
            share = _share_done(step, started, training)
            pairs = split.train[draw.integers(len(split.train), size=training.batch)]
            batch = sampler.batch(pairs, draw.choice(sampler.queries, size=asked, replace=False))
            loss = mean_squared_error(network, scaling, batch)
            _step(optimisers, loss, one_cycle(share))
            rmse.append(scaling.unit * math.sqrt(VALUES * loss.item()))
            log.write(step, loss=loss.item(), rmse_mm=rmse[-1])
            if step % training.triangulate_every == 0:
                network.triangulate()
            if progress is not None:
                progress(step, training.steps, rmse[-1])
            if share >= 1:
                break
    network.triangulate()
    seconds = time.perf_counter() - started
    record = TrainingRecord(training, np.array(rmse), seconds, nodes_before, _nodes_in_mm(network, scaling))
    return Gen(network.eval(), scaling, sampler.sensors, sampler.source, split.protocol, record)


def one_cycle(share: float) -> float:
    """Rate over its largest value [-] at this share of the training."""
    if share < RISE:
        return share / RISE
    return (1 + math.cos(math.pi * (min(share, 1) - RISE) / (1 - RISE))) / 2


def _share_done(step: int, started: float, training: TrainingConfig) -> float:
    """Share of the steps, or of the time where that is further on."""
    share = step / training.steps
    if training.seconds is None:
        return share
    return max(share, (time.perf_counter() - started) / training.seconds)


def _optimisers(network: GraphElementNetwork, training: TrainingConfig) -> list[torch.optim.Optimizer]:
    """Adam for the weights and Adam for the nodes; each group knows its largest rate."""
    processor = [*network.convolution.parameters(), *network.norm.parameters()]
    others = [*network.encoder.parameters(), *network.decoder.parameters(), network.log_sharpness]
    rate, rounds = training.learning_rate, network.config.message_rounds
    groups = [{"params": others, "largest": rate}, {"params": processor, "largest": rate / rounds}]
    nodes = [{"params": [network.nodes], "largest": training.node_learning_rate}]
    return [torch.optim.Adam(of, betas=BETAS, fused=True) for of in (groups, nodes)]


def _step(optimisers: list[torch.optim.Optimizer], loss: Float[torch.Tensor, ""], rate: float) -> None:
    """One step of all optimisers, at this share of their largest rates."""
    for optimiser in optimisers:
        optimiser.zero_grad()
    loss.backward()
    for optimiser in optimisers:
        for group in optimiser.param_groups:
            group["lr"] = rate * group["largest"]
        optimiser.step()


def _nodes_in_mm(network: GraphElementNetwork, scaling: Scaling) -> Float[np.ndarray, "nodes 3"]:
    return scaling.out_of_box(network.nodes.detach().double().numpy())
