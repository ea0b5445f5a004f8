"""How far a method is off on some pairs, and how far it says it may be: what intervals are calibrated on."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.fields import FIELDS
from myograph.inference.signature import RESIDUAL
from myograph.inference.ways import WHOLE, Way, told_only, ways
from myograph.learning.torch_predictor import TorchPredictor

BATCH = 32


@dataclass(frozen=True)
class Scores:
    """Of every node in every pair, by field.

    Parameters
    ----------
    errors, deviations
        Distance or absolute error, and the deviation that the method says, in the field's unit; one where it says none.
    residuals
        Of the sensors, of each pair [mm]; none where the method gives none.
    """

    errors: Mapping[str, Float[np.ndarray, "pairs nodes"]]
    deviations: Mapping[str, Float[np.ndarray, "pairs nodes"]]
    residuals: Float[np.ndarray, " residuals"]


def scores(predictor: Predictor, sampler: PairSampler, pairs: Int[np.ndarray, "pairs 2"], way: str = WHOLE) -> Scores:
    """At all queries of the sampler, the method being told in this way (`myograph.inference.ways`)."""
    errors: dict[str, list[np.ndarray]] = {}
    deviations: dict[str, list[np.ndarray]] = {}
    residuals = [np.zeros(0)]
    for batch in sampler.batches(pairs, BATCH):
        question = told_only(batch.question, way)
        answer = predictor.predict(question)
        for name in set(answer.values) & set(batch.truth):
            if name == "position" or not FIELDS[name].components:
                errors.setdefault(name, []).append(distance(answer.values[name], batch.truth[name], name))
                deviations.setdefault(name, []).append(deviation_of(answer, name))
        residual = residual_of(predictor, question)
        residuals += [] if residual is None else [residual]
    return Scores(_joined(errors), _joined(deviations), np.concatenate(residuals))


def _joined(parts: dict[str, list[np.ndarray]]) -> dict[str, np.ndarray]:
    return {name: np.concatenate(own) for name, own in parts.items()}


def ways_of(predictor: Predictor) -> tuple[Way, ...]:
    """How else than by everything a method may be told; of methods that do not say what they take, none."""
    return ways(predictor.signature) if isinstance(predictor, TorchPredictor) else ()


def distance(predicted: np.ndarray, true: np.ndarray, name: str) -> np.ndarray:
    """Error of every node in every pair, in the field's unit."""
    missed = predicted.astype(np.float64) - true
    return np.linalg.norm(missed, axis=-1) if FIELDS[name].components else np.abs(missed)


def deviation_of(answer: Answer, name: str) -> np.ndarray:
    """What it says, or one."""
    return answer.deviation.get(name, np.ones(answer.values[name].shape[:2]))


def residual_of(predictor: Predictor, question: Question) -> np.ndarray | None:
    """What the method cannot explain of what its sensors say [mm], where it tells."""
    if not isinstance(predictor, TorchPredictor) or RESIDUAL not in predictor.signature.outputs:
        return None
    return predictor.outputs(question)[RESIDUAL]
