"""Make the models that come with the package, of stores of cases of the built-in arm.

    python benchmarks/make_models.py --arm STORE --biceps STORE --truth STORE --arm-truth STORE [--out FOLDER]

    --arm       arm/MUSCLE      all five muscles, with one network for the elbow's angle
    --biceps    biceps          one muscle, finer; gen-biceps: a graph element network in the convention of the thesis
    --truth     truth/biceps.npz        cases that the biceps is held against
    --arm-truth truth/arm/MUSCLE.npz    likewise the arm; with --arm, its cases that are not shipped widen intervals

Any of them may be left out: what lies there stays. Models are taught by the protocol 'strict' and calibrated on 15 % of
the training cases, which teach nothing. The truth of the biceps should be of finite elements (simulator 'direct'), with
cases of the design 'off_grid' and the 32 factorial ones; a truth has the sizes of bodies of the store that teaches.
Of the truth of the biceps one half of the cases off the grid, drawn at random, becomes the truth that is shipped; with
--biceps, the other half says how far the angle of its network is off, and how wide its intervals must be for each way
of asking it: by activations, by sensors, by both.
"""

import argparse
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import torch

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, PROTOCOLS, PairSet, Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.evaluation import evaluate
from myograph.inference.truth import write_truth
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.modes.arm import fit_arm
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.fitting import measure_angle
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.modes.module import ModesModule
from myograph.learning.saving import Training, save_model
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.training import TrainingConfig
from myograph.learning.trust.calibrated import CalibratedLearner, CalibratedPredictor, calibrate, hold_out

ASKED = ("position", "von_mises")
SHOWN = (*ASKED, "fibre_stretch")
"""What the arm answers, beside what it is judged by: what the page colours by."""
ARM = ModesConfig(reads="both", stress="von_mises", kept="float16", modes=16, modes_of={"fibre_stretch": 8})
BICEPS = ModesConfig(reads="both", stress="von_mises", kept="float16", modes=20)
GEN = NetworkConfig.improved().model_copy(update={"latent": 32, "hidden": (32, 32)})
STEPS = TrainingConfig(steps=4000, queries=128)
LIMITS = ("Von Mises stress has modes of its own: where there is hardly any, it may come out a little below zero.",)
COMMANDS = {"biceps": "--biceps STORE --truth STORE", "gen-biceps": "--biceps STORE"}
"""What makes single models, as their cards say it."""
FEW = 8
"""Cases off the grid that the arm is held against."""
TESTED = 256
"""Test pairs of each protocol, at most."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Make what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for what in ("arm", "biceps", "truth", "arm-truth"):
        parser.add_argument(f"--{what}", type=Path, metavar="STORE")
    parser.add_argument("--out", type=Path, default=Path("src/myograph/models"))
    parser.add_argument("--without-gen", action="store_true", help="make no graph element network")
    asked = parser.parse_args(arguments)
    torch.set_num_threads(1)
    if asked.arm:
        make_arm(asked.arm, asked.arm_truth, asked.out / "arm")
    if asked.biceps:
        make_biceps(asked.biceps, asked.truth, asked.out / "biceps")
        if not asked.without_gen:
            make_gen(asked.biceps, asked.out / "gen-biceps")
    if asked.truth:
        make_truth(asked.truth, "biceps", asked.out / "truth" / "biceps.npz", halved=True)
    for muscle in MUSCLES if asked.arm_truth else ():
        make_truth(asked.arm_truth, muscle, asked.out / "truth" / "arm" / f"{muscle}.npz")


def make_arm(store: Path, truth: Path | None, out: Path) -> None:
    """Five models that share one network for the elbow's angle."""
    started = time.perf_counter()
    samplers = {muscle: _sampler(store, muscle, SHOWN) for muscle in MUSCLES}
    split = split_pairs(samplers[MUSCLES[0]].cases, "strict")
    rest, held_out = hold_out(samplers[MUSCLES[0]].cases, split, CalibratedLearner.share, 0)
    found = fit_arm(ModesLearner(ARM), samplers, rest)
    for muscle, model in found.items():
        calibrated = calibrate(model, samplers[muscle], rest, held_out)
        if truth is not None:
            calibrated = widened(calibrated, _sampler(truth, muscle, SHOWN))
        _save(calibrated, samplers[muscle], rest, (time.perf_counter() - started) / len(MUSCLES), out / muscle)


def make_biceps(store: Path, truth: Path | None, out: Path) -> None:
    """Neural modes of one muscle that answer from activations, from sensors, or from both."""
    sampler, started = _sampler(store, "biceps"), time.perf_counter()
    split = split_pairs(sampler.cases, "strict")
    rest, _ = hold_out(sampler.cases, split, CalibratedLearner.share, 0)
    calibrated = CalibratedLearner(ModesLearner(BICEPS)).fit(sampler, split)
    if truth is not None:
        calibrated = _against_truth(calibrated, _sampler(truth, "biceps"))
    _save(calibrated, sampler, rest, time.perf_counter() - started, out)


def make_gen(store: Path, out: Path) -> None:
    """A graph element network that reads nine sensors, in the convention of the thesis."""
    cases = read_muscle(store, "biceps")
    sampler, started = PairSampler(cases, random_sensors(cases.nodes)), time.perf_counter()
    split = split_pairs(cases, "strict")
    rest, _ = hold_out(cases, split, CalibratedLearner.share, 0)
    calibrated = CalibratedLearner(GenLearner(GEN, STEPS, "gen_8_improved")).fit(sampler, split)
    _save(calibrated, sampler, rest, time.perf_counter() - started, out)


def make_truth(store: Path, muscle: str, out: Path, halved: bool = False) -> None:
    """Half of the cases off the grid and all corners of the cube of activations; or a few off the grid."""
    cases = read_muscle(store, muscle)
    chosen = cases.named(OFF_GRID)[:FEW]
    if halved:
        chosen = np.concatenate([np.sort(_halves(cases)[1]), cases.named(FACTORIAL)])
    out.parent.mkdir(parents=True, exist_ok=True)
    write_truth(out, cases, chosen, ASKED)
    print(f"{out}: {len(chosen)} cases, {out.stat().st_size / 1e6:.2f} MB")


def _halves(cases: MuscleCases) -> tuple[np.ndarray, np.ndarray]:
    """Cases off the grid that calibrate, and those that are the truth."""
    shuffled = np.random.default_rng(0).permutation(cases.named(OFF_GRID))
    return shuffled[: len(shuffled) // 2], shuffled[len(shuffled) // 2 :]


def _against_truth(calibrated: CalibratedPredictor, sampler: PairSampler) -> CalibratedPredictor:
    """The deviation of its angle, and its factors, from cases of the truth that are not shipped."""
    cases, model = sampler.cases, calibrated.predictor
    assert isinstance(model, TorchPredictor)
    assert isinstance(model.module, ModesModule)
    chosen = _halves(cases)[0]
    measure_angle(model.module, cases, chosen)
    found = _calibrated_on(model, sampler, chosen)
    return replace(calibrated, factors=found.factors, factors_from=found.factors_from)


def widened(calibrated: CalibratedPredictor, sampler: PairSampler) -> CalibratedPredictor:
    """With the factors that the truth needs, of cases off the grid that are not shipped, where these are larger."""
    found = _calibrated_on(calibrated.predictor, sampler, sampler.cases.named(OFF_GRID)[FEW:])
    return replace(
        calibrated,
        factors=_larger(calibrated.factors, found.factors),
        factors_from={way: _larger(own, found.factors_from[way]) for way, own in calibrated.factors_from.items()},
    )


def _calibrated_on(model: Predictor, sampler: PairSampler, chosen: np.ndarray) -> CalibratedPredictor:
    split = Split("off_grid", PairSet(chosen, chosen), np.zeros((0, 2), dtype=np.int64))
    return calibrate(model, sampler, split, chosen)


def _larger(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    return {name: max(factor, other[name]) for name, factor in one.items()}


def _sampler(store: Path, muscle: str, asked: tuple[str, ...] = ASKED) -> PairSampler:
    cases = read_muscle(store, muscle)
    return PairSampler(cases, random_sensors(cases.nodes), "material", asked=asked)


def _save(model: CalibratedPredictor, sampler: PairSampler, taught: Split, seconds: float, out: Path) -> None:
    what = "--arm STORE --arm-truth STORE" if out.parent.name == "arm" else COMMANDS[out.name]
    metrics = {}
    for protocol in PROTOCOLS:
        test = split_pairs(sampler.cases, protocol).test
        chosen = test[np.sort(np.random.default_rng(0).permutation(len(test))[:TESTED])]
        metrics[protocol] = evaluate(model, sampler.batches(chosen)).summary().known_figures()
    training = Training(
        sampler.cases,
        taught,
        command=f"python benchmarks/make_models.py {what}",
        seconds=seconds,
        metrics=metrics,
        half_width_90=model.factors,
        half_width_90_from=model.factors_from,
        residual_mm=model.residual_mm,
        limits=LIMITS if "von_mises" in model.fields else (),
    )
    save_model(model.predictor, training, out)
    size = sum(path.stat().st_size for path in out.iterdir())
    print(f"{out}: {size / 1e6:.2f} MB, {seconds:.0f} s")
    for protocol, figures in metrics.items():
        print(f"  {protocol:9}" + "".join(f" {name} {value:.4g}" for name, value in figures.items()))


if __name__ == "__main__":
    main()
