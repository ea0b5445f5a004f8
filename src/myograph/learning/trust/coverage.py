"""What share of the truth lies in the 90 % intervals, measured on any pairs."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.trust.scores import distance

BATCH = 32


@dataclass(frozen=True)
class Coverage:
    """Of one field: share of nodes in their intervals over all pairs [-], mean half width in the field's unit."""

    share: float
    half_width: float


def coverage(predictor: Predictor, sampler: PairSampler, pairs: Int[np.ndarray, "pairs 2"]) -> dict[str, Coverage]:
    """By field; raises InputError for no pairs, or for a predictor that gives no intervals."""
    if not len(pairs):
        raise InputError("coverage: expected at least one pair, got none")
    held: dict[str, list[np.ndarray]] = {}
    widths: dict[str, list[np.ndarray]] = {}
    for batch in sampler.batches(pairs, BATCH):
        answer = predictor.predict(batch.question)
        for name in set(answer.half_width_90) & set(batch.truth):
            width = answer.half_width_90[name]
            held.setdefault(name, []).append(distance(answer.values[name], batch.truth[name], name) <= width)
            widths.setdefault(name, []).append(width)
    if not held:
        raise InputError(f"coverage: expected a predictor with 90 % intervals, got '{predictor.name}'; calibrate it")
    return {
        name: Coverage(float(np.concatenate(found).mean()), float(np.concatenate(widths[name]).mean()))
        for name, found in held.items()
    }
