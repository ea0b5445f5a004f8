"""T = A p + b by least squares on the sensors; p is the place of a point: S, or X in the convention 'material'."""

from typing import final

import numpy as np
from jaxtyping import Float

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.learning.baselines.sensed import check_spatial, sensed_movement


@final
class Affine:
    """The affine map that suits the sensors best; learns nothing."""

    name = "affine"
    fields = ("position",)

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> "Affine":
        """There is nothing to learn."""
        return self

    def predict(self, question: Question) -> Answer:
        """Map the queries [mm]; raises InputError for fewer than four sensors, or where they lie in one plane."""
        places, targets = sensed_movement(question)
        check_spatial(places)
        centre = places.mean(axis=1, keepdims=True)
        inverse = np.linalg.pinv(_with_one(places - centre))
        return Answer({"position": _with_one(question.query_places - centre) @ (inverse @ targets)})


def _with_one(points: Float[np.ndarray, "batch points 3"]) -> Float[np.ndarray, "batch points 4"]:
    return np.concatenate([points, np.ones_like(points[..., :1])], axis=-1)
