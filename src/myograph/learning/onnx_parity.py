"""Whether an exported network answers as its torch module does, for every number of pairs and sensors it may meet."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from myograph.config import Model
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Question
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError, NotConvergedError
from myograph.inference.feeds import FIELD_PARTS, feeds
from myograph.inference.session import open_session, run_session
from myograph.inference.signature import Signature
from myograph.learning.saveable import Saveable
from myograph.learning.torch_predictor import TorchPredictor

PARITY = 1e-5
EXAMPLE, ONE, SOME = (2, 7), (1, 5), (3, 11)
"""Pairs and queries of the question that is exported with, and of those that are compared on."""


def example_question(
    signature: Signature, cases: MuscleCases, split: Split, size: tuple[int, int] = EXAMPLE
) -> Question:
    """A question about that many training pairs, at that many queries, as the signature wants it."""

    told = tuple(
        field for field in cases.fields if {part.format(field) for part in FIELD_PARTS} & set(signature.inputs)
    )
    sensors = np.array(signature.sensors, dtype=np.int64)
    sensors = sensors if len(sensors) else random_sensors(cases.nodes, 1)
    sampler = PairSampler(cases, sensors, signature.convention, told, told)
    generator = np.random.default_rng(0)
    asked = generator.choice(sampler.queries, min(size[1], len(sampler.queries)), replace=False)
    return sampler.batch(split.train.draw(generator, size[0]), asked).question


def check_parity(model: Saveable, network: bytes, cases: MuscleCases, split: Split) -> float:
    """Largest difference over the largest value of an output.

    Raises NotConvergedError where that exceeds `PARITY`, InputError where the module does not take what it must.
    """
    torch_model = TorchPredictor(model.name, model.method, model.module, model.signature, Model())
    session = open_session(network, model.signature, threads=1, source=model.name)
    worst = 0.0
    for question in _trials(model.signature, cases, split):
        wanted = _outputs(torch_model, question)
        found = run_session(session, feeds(question, model.signature.inputs), model.signature.outputs)
        for name, values in wanted.items():
            worst = max(worst, _difference(values, found[name]))
    if not worst <= PARITY:
        raise NotConvergedError(
            f"{model.name}: expected onnxruntime to answer like torch within {PARITY:g} of the largest value, got "
            f"{worst:.2g}; nothing was saved"
        )
    return worst


def _outputs(model: TorchPredictor, question: Question) -> dict[str, np.ndarray]:
    try:
        return model.outputs(question)
    except RuntimeError as problem:
        raise InputError(
            f"{model.name}: expected a module for any number of pairs and queries, got one that fails for "
            f"{question.size} pairs and {len(question.query_nodes)} queries: {problem}"
        ) from problem


def _trials(signature: Signature, cases: MuscleCases, split: Split) -> Iterator[Question]:
    some = example_question(signature, cases, split, SOME)
    yield some
    yield example_question(signature, cases, split, ONE)
    if signature.any_sensors and len(some.sensor_nodes) > max(signature.least_sensors, 1):
        yield _from_sensors(some, len(some.sensor_nodes) - 1)
    if signature.takes_sensors and signature.least_sensors == 0:
        yield _from_sensors(some, 0)
    if signature.unknown_activation:
        yield replace(some, activation=np.full_like(some.activation, np.nan))


def _from_sensors(question: Question, count: int) -> Question:
    """The question with its first sensors only."""
    return replace(
        question,
        sensor_nodes=question.sensor_nodes[:count],
        sensor_places=question.sensor_places[:, :count],
        sensor_initial={name: values[:, :count] for name, values in question.sensor_initial.items()},
        sensor_target={name: values[:, :count] for name, values in question.sensor_target.items()},
    )


def _difference(wanted: np.ndarray, found: np.ndarray) -> float:
    """Infinite for another shape, and where only one is a number."""
    if wanted.shape != found.shape or not np.array_equal(np.isnan(wanted), np.isnan(found)):
        return float("inf")
    scale = np.nanmax(np.abs(wanted), initial=0.0)
    difference = np.nanmax(np.abs(wanted - found), initial=0.0)
    return float(difference / scale) if scale > 0 else float(difference)
