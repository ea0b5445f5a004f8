"""Second half of the demo: networks learn, and every method is held against the truth."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from myograph.cli.demo.sizes import MUSCLE, SEED, SENSORS, DemoSize
from myograph.cli.progress import Steps
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import PROTOCOLS, Protocol, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.evaluation import ErrorSummary, NodeErrors, evaluate
from myograph.learning.baselines import BASELINES
from myograph.processes import News, side_by_side

if TYPE_CHECKING:
    from myograph.learning.gen.learner import TrainedGen

TAUGHT_BY: dict[Protocol, Protocol] = {"thesis": "thesis", "strict": "strict", "off_grid": "thesis"}
"""Protocols that train on the same pairs share a network."""
METHODS = ("do_nothing", "affine", "thin_plate_spline")
NEWS_EVERY = 10

Networks = dict[tuple[int, Protocol], "TrainedGen"]
"""By nodes per axis and the protocol that taught."""


@dataclass(frozen=True)
class Comparison:
    """What the methods reached: errors of every node [mm] by method and protocol, and the trained networks."""

    sampler: PairSampler
    errors: dict[str, dict[Protocol, NodeErrors]]
    summaries: dict[str, dict[str, ErrorSummary]]
    networks: Networks


def learn(store: Path, size: DemoSize, out: Path, steps: Steps) -> Networks:
    """Train both networks on the pairs of each teaching protocol, side by side."""
    taught: tuple[Protocol, ...] = ("thesis", "strict")
    longest_first = sorted(size.steps, reverse=True)
    which: list[tuple[int, Protocol]] = [(axis, protocol) for axis in longest_first for protocol in taught]
    totals = {_title(axis, protocol): size.steps[axis] for axis, protocol in which}
    with steps.bars("training", totals) as advance:

        def heard(title: str) -> None:
            for _ in range(NEWS_EVERY):
                advance(title)

        trained = side_by_side(_train, [(store, key, size, out) for key in which], heard)
    return dict(zip(which, trained, strict=True))


def compare(cases: MuscleCases, networks: Networks, steps: Steps) -> Comparison:
    """Errors of all methods under all protocols."""
    sampler = _sampler(cases)
    axes = sorted({axis for axis, _ in networks})
    methods = [*METHODS, *(f"gen_{axis**3}" for axis in axes)]
    errors: dict[str, dict[Protocol, NodeErrors]] = {method: {} for method in methods}
    summaries: dict[str, dict[str, ErrorSummary]] = {method: {} for method in methods}
    with steps.bars("evaluation", dict.fromkeys(PROTOCOLS, len(methods))) as advance:
        for protocol in PROTOCOLS:
            pairs = split_pairs(cases, protocol, SEED).test
            predictors = {method: BASELINES[method] for method in METHODS}
            predictors |= {f"gen_{axis**3}": networks[axis, TAUGHT_BY[protocol]].predictor for axis in axes}
            for method, predictor in predictors.items():
                found = evaluate(predictor, sampler.batches(pairs))
                assert found.position is not None
                errors[method][protocol], summaries[method][protocol] = found.position, found.summary()
                advance(protocol)
    return Comparison(sampler, errors, summaries, networks)


def save(comparison: Comparison, out: Path, command: str, steps: Steps) -> None:
    """Write the networks as models that are loaded by `myograph.load`."""
    from myograph.learning.saving import Training, save_model

    cases = comparison.sampler.cases
    with steps.bars("models", {"networks": len(comparison.networks)}) as advance:
        for (axis, taught), network in comparison.networks.items():
            reached = comparison.summaries[network.predictor.name]
            metrics = {p: reached[p].known_figures() for p, by in TAUGHT_BY.items() if by == taught}
            training = Training(
                cases,
                split_pairs(cases, taught, SEED),
                split_seed=SEED,
                seed=SEED,
                command=command,
                seconds=network.history.seconds,
                metrics=metrics,
            )
            save_model(network.predictor, training, out / "models" / _folder_name(axis, taught))
            advance("networks")


def _train(store: Path, which: tuple[int, Protocol], size: DemoSize, out: Path, tell: News) -> "TrainedGen":
    from myograph.learning.gen.config import NetworkConfig
    from myograph.learning.gen.learner import GenLearner
    from myograph.learning.training import TrainingConfig

    axis, protocol = which
    cases, title = read_muscle(store, MUSCLE), _title(axis, protocol)
    network = NetworkConfig(nodes_per_axis=axis)
    training = TrainingConfig(steps=size.steps[axis], seed=SEED, device="cpu", tensorboard=True)
    told = f"{cases.checksum} {network.model_dump_json()} {training.model_dump_json()}"
    folder = out / "training" / f"{_folder_name(axis, protocol)}-{hashlib.sha256(told.encode()).hexdigest()[:8]}"
    return GenLearner(network, training, folder=folder).train(
        _sampler(cases),
        split_pairs(cases, protocol, SEED),
        lambda step, _steps, _rmse: tell(title) if step % NEWS_EVERY == 0 else None,
    )


def _sampler(cases: MuscleCases) -> PairSampler:
    return PairSampler(cases, random_sensors(cases.nodes, SENSORS, SEED))


def _title(axis: int, protocol: Protocol) -> str:
    return f"gen_{axis**3}, {protocol}"


def _folder_name(axis: int, protocol: Protocol) -> str:
    return f"gen_{axis**3}-{protocol}"
