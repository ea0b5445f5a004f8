"""The smoothest map that takes every sensor to its place.

T = A p + b + sum_i w_i |p - p_i|² log |p - p_i| through the sensors p_i; p is the place of a point: S, or X in the
convention 'material'. Source: Bookstein 1989; `scipy.interpolate.RBFInterpolator`.
"""

from typing import final

import numpy as np
from scipy.interpolate import RBFInterpolator

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.learning.baselines.sensed import check_spatial, sensed_movement


@final
class ThinPlateSpline:
    """A spline through the sensors; learns nothing."""

    name = "thin_plate_spline"
    fields = ("position",)

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> "ThinPlateSpline":
        """There is nothing to learn."""
        return self

    def predict(self, question: Question) -> Answer:
        """Map the queries [mm]; raises InputError for fewer than four sensors, or where they lie in one plane."""
        places, targets = sensed_movement(question)
        check_spatial(places)
        answers = [
            RBFInterpolator(own, moved, kernel="thin_plate_spline")(asked)
            for own, moved, asked in zip(places, targets, question.query_places, strict=True)
        ]
        return Answer({"position": np.array(answers).reshape(question.query_places.shape)})
