"""Second half of the demo: networks learn, and every method is held against the truth."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from jaxtyping import Int

from myograph.cli.demo.sizes import SEED, SENSORS, DemoSize
from myograph.cli.progress import Steps
from myograph.ensemble.pairs import PairSampler, sample_pairs
from myograph.ensemble.protocols import PROTOCOLS, Protocol, split_pairs
from myograph.evaluation import ErrorSummary, NodeErrors, evaluate
from myograph.learning.baselines import BASELINES
from myograph.processes import News, side_by_side

if TYPE_CHECKING:
    from myograph.learning.gen import Gen

TAUGHT_BY: dict[Protocol, Protocol] = {"thesis": "thesis", "strict": "strict", "off_grid": "thesis"}
"""Protocols that train on the same pairs share a network."""
PAIRS_AT_ONCE = 32
NEWS_EVERY = 10


@dataclass(frozen=True)
class Comparison:
    """What the methods reached: errors of every node by method and protocol, and the trained networks."""

    sampler: PairSampler
    errors: dict[str, dict[Protocol, NodeErrors]]
    networks: dict[tuple[int, Protocol], "Gen"]

    @property
    def summaries(self) -> dict[str, dict[str, ErrorSummary]]:
        """Method -> protocol -> errors [mm]."""
        return {
            method: {protocol: errors.summary() for protocol, errors in row.items()}
            for method, row in self.errors.items()
        }


def learn(dataset: xr.Dataset, size: DemoSize, out: Path, steps: Steps) -> dict[tuple[int, Protocol], "Gen"]:
    """Train both networks on the pairs of each teaching protocol, side by side."""
    taught: tuple[Protocol, ...] = ("thesis", "strict")
    longest_first = sorted(size.steps, reverse=True)
    which: list[tuple[int, Protocol]] = [(axis, protocol) for axis in longest_first for protocol in taught]
    totals = {_title(axis, protocol): size.steps[axis] for axis, protocol in which}
    with steps.bars("training", totals) as advance:

        def heard(title: str) -> None:
            for _ in range(NEWS_EVERY):
                advance(title)

        trained = side_by_side(_train, [(dataset, key, size, out) for key in which], heard)
    return dict(zip(which, trained, strict=True))


def compare(dataset: xr.Dataset, networks: dict[tuple[int, Protocol], "Gen"], steps: Steps) -> Comparison:
    """Errors of all methods under all protocols."""
    sampler = sample_pairs(dataset, SENSORS, SEED)
    axes = sorted({axis for axis, _ in networks})
    methods = [*BASELINES, *(f"gen_{axis**3}" for axis in axes)]
    errors: dict[str, dict[Protocol, NodeErrors]] = {method: {} for method in methods}
    with steps.bars("evaluation", dict.fromkeys(PROTOCOLS, len(methods))) as advance:
        for protocol in PROTOCOLS:
            pairs = split_pairs(dataset, protocol, SEED).test
            predictors = {**BASELINES, **{f"gen_{a**3}": networks[a, TAUGHT_BY[protocol]] for a in axes}}
            for method, predictor in predictors.items():
                errors[method][protocol] = evaluate(predictor, _samples(sampler, pairs))
                advance(protocol)
    return Comparison(sampler, errors, networks)


def _train(dataset: xr.Dataset, which: tuple[int, Protocol], size: DemoSize, out: Path, tell: News) -> "Gen":
    from myograph.learning.checkpoint import save_gen
    from myograph.learning.config import NetworkConfig, TrainingConfig
    from myograph.learning.training import train_gen

    axis, protocol = which
    sampler, split = sample_pairs(dataset, SENSORS, SEED), split_pairs(dataset, protocol, SEED)
    title = _title(axis, protocol)
    network = train_gen(
        sampler,
        split,
        NetworkConfig(nodes_per_axis=axis),
        TrainingConfig(steps=size.steps[axis], seed=SEED),
        progress=lambda step, _steps, _rmse: tell(title) if step % NEWS_EVERY == 0 else None,
        log_to=out / "tensorboard" / title.replace(", ", "-"),
    )
    save_gen(network, out / "models" / title.replace(", ", "-"))
    return network


def _title(axis: int, protocol: Protocol) -> str:
    return f"gen_{axis**3}, {protocol}"


def _samples(sampler: PairSampler, pairs: Int[np.ndarray, "pairs 2"]) -> Iterator[tuple]:
    for first in range(0, len(pairs), PAIRS_AT_ONCE):
        batch = sampler.batch(pairs[first : first + PAIRS_AT_ONCE])
        yield batch.sensors, batch.queries, batch.targets
