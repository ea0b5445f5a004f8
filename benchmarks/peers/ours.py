"""Our methods, measured as `run_peer.py` measures peers: by the same clock, on the same cases."""

import itertools
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
from export_cases import arrays_of
from run_peer import errors, size_of

import myograph
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Protocol, Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.fields import von_mises
from myograph.learning.learners import Asked, make_learner
from myograph.learning.training import run as training_run

OURS: dict[str, tuple[str, dict[str, object], str]] = {
    "neural_modes": ("neural_modes", {}, "activations"),
    "pod_gp": ("pod_gp", {}, "activations"),
    "feed_forward": ("feed_forward", {}, "activations"),
    "deeponet": ("deeponet", {}, "activations"),
    "gen_thesis_8": ("gen_thesis", {}, "sensors"),
    "neural_modes, sensors": ("neural_modes", {"reads": "sensors"}, "sensors"),
}
"""Row -> method, options, what it is told."""
STEPPED = ("feed_forward", "deeponet", "gen_thesis")
MANY = 10**9
"""Steps: more than a limit has room for, so that the clock ends the training."""


def ours(name: str, cases: MuscleCases, protocol: Protocol, seconds: float, seed: int) -> dict[str, object]:
    """Errors, times and numbers of a method of ours."""
    method, options, reads = OURS[name]
    stress = () if method == "gen_thesis" else ("von_mises",)
    convention = "initial" if method == "gen_thesis" else "material"
    sampler = PairSampler(cases, random_sensors(cases.nodes), convention, asked=("position", *stress))
    split = split_pairs(cases, protocol, seed)
    training = {"seed": seed, "steps": MANY, "seconds": seconds} if method in STEPPED else {}
    predictor, told = _taught(Asked(method, options, training), sampler, split)
    targets = np.unique(split.test[:, 1])
    pairs = np.array([split.test[np.flatnonzero(split.test[:, 1] == target)[0]] for target in targets])
    answers = [predictor.predict(batch.question).values for batch in sampler.batches(pairs)]
    told |= {"predict_ms": _milliseconds(predictor, sampler, pairs), "reads": reads}
    told["install_mb"] = size_of(Path(myograph.__file__).parent.rglob("*"))
    told["anywhere"] = method in ("gen_thesis", "deeponet")
    told["numbers"] = sum(values.numel() for values in predictor.module.state_dict().values())  # type: ignore[attr-defined]
    return {**told, **errors(_everywhere(answers, sampler), arrays_of(cases, seed), targets)}


@contextmanager
def processor_clock() -> Iterator[None]:
    """A training that begins in here counts the processor's seconds, as peers do, from here on."""
    readings = itertools.chain([time.process_time()], iter(time.process_time, None))
    with mock.patch.object(training_run, "time", SimpleNamespace(perf_counter=lambda: next(readings))):
        yield


def _taught(asked: Asked, sampler: PairSampler, split: Split) -> tuple[Predictor, dict[str, object]]:
    """What has learned; its seconds, and its steps if it takes some."""
    learner, taken = make_learner(asked), []
    progress = (lambda step, steps, error: taken.append(step)) if asked.training else None
    started = time.process_time()
    with processor_clock():
        predictor = learner.fit(sampler, split, progress)
    learning = time.process_time() - started
    return predictor, {"train_s": learning, "steps": float(len(taken)) if asked.training else None}


def _everywhere(answers: list, sampler: PairSampler) -> dict[str, np.ndarray]:
    """Answers at all nodes; sensors are no errors of anybody, and are left out later."""
    found = {}
    for name in answers[0]:
        values = np.concatenate([answer[name] for answer in answers])
        whole = np.zeros((len(values), sampler.cases.nodes, *values.shape[2:]))
        whole[:, sampler.queries] = values
        found[name] = whole
    if "cauchy_stress" in found and "von_mises" not in found:
        found["von_mises"] = von_mises(found["cauchy_stress"])
    return found


def _milliseconds(predictor: Predictor, sampler: PairSampler, pairs: np.ndarray) -> float:
    question = sampler.batch(pairs[:1]).question
    times = []
    for _ in range(10):
        started = time.perf_counter()
        predictor.predict(question)
        times.append(time.perf_counter() - started)
    return 1000 * float(np.median(times))
