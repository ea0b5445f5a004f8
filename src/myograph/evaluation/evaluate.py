"""A method held against the truth, batch by batch: only errors are kept."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Float32

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.question import Answer, Batch, FieldValues
from myograph.errors import InputError
from myograph.evaluation.metrics import NodeErrors, node_errors, stress_errors
from myograph.evaluation.summary import Evaluation
from myograph.fields import von_mises


def evaluate(predictor: Predictor, batches: Iterable[Batch]) -> Evaluation:
    """Errors of a predictor in position and von Mises stress, where it answers them and the truth is at hand.

    A Cauchy stress stands for the von Mises stress that follows from it. The queries must be the same nodes in all
    batches. Raises InputError for no pair at all, and for a predictor whose answers have none of the asked fields.
    """
    position, stress, inside = _Gathered(), _Gathered(), []
    for batch in batches:
        answer = predictor.predict(batch.question)
        _add_position(position, batch, answer)
        _add_stress(stress, batch, answer)
        if answer.inside is not None:
            inside.append(answer.inside)
    if not (position.errors or stress.errors):
        raise InputError(
            f"{predictor.name}: expected at least one pair to evaluate, in position or stress, got none: is the test "
            "split empty, or nothing asked of what the method answers?"
        )
    share = float(np.concatenate(inside).mean()) if inside else None
    return Evaluation(position.whole(), stress.whole(), share)


@dataclass
class _Gathered:
    """Errors of one field so far."""

    errors: list[Float32[np.ndarray, "batch nodes"]] = field(default_factory=list)
    scale: float = 0.0
    within: int = 0
    told: int = 0

    def add(self, errors: Float32[np.ndarray, "batch nodes"], scales: np.ndarray) -> None:
        if not len(errors):
            return
        self.errors.append(errors)
        self.scale += float(scales.sum(dtype=np.float64))
        if errors.shape[1] != self.errors[0].shape[1]:
            raise InputError(f"expected {self.errors[0].shape[1]} queries in every batch, got {errors.shape[1]}")

    def cover(self, errors: Float32[np.ndarray, "batch nodes"], half_width: np.ndarray | None) -> None:
        if half_width is not None:
            self.within += int(np.count_nonzero(errors <= half_width))
            self.told += errors.size

    def whole(self) -> NodeErrors | None:
        if not self.errors:
            return None
        gathered = np.concatenate(self.errors)
        return NodeErrors(gathered, self.scale / gathered.size, self.within / self.told if self.told else None)


def _add_position(gathered: _Gathered, batch: Batch, answer: Answer) -> None:
    if "position" not in answer.values or "position" not in batch.truth:
        return
    true = batch.truth["position"]
    errors = node_errors(answer.values["position"], true)
    gathered.add(errors, node_errors(batch.question.query_initial["position"], true))
    gathered.cover(errors, answer.half_width_90.get("position"))


def _add_stress(gathered: _Gathered, batch: Batch, answer: Answer) -> None:
    predicted, true = _von_mises(answer.values), _von_mises(batch.truth)
    if predicted is None or true is None:
        return
    errors = stress_errors(predicted, true)
    gathered.add(errors, true)
    gathered.cover(errors, answer.half_width_90.get("von_mises"))


def _von_mises(values: FieldValues) -> Float[np.ndarray, "batch nodes"] | None:
    if "von_mises" in values:
        return values["von_mises"]
    return von_mises(values["cauchy_stress"]) if "cauchy_stress" in values else None
