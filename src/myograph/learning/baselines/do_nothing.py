"""Nothing changes from the initial to the target case: T = S, and stress stays as it was. The scale of every error."""

from typing import final

import numpy as np

from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler


@final
class DoNothing:
    """Every point stays where it was; learns nothing."""

    name = "do_nothing"
    fields = NODE_FIELDS

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> "DoNothing":
        """There is nothing to learn."""
        return self

    def predict(self, question: Question) -> Answer:
        """The fields of the initial case that the question tells."""
        return Answer({name: np.array(values) for name, values in question.query_initial.items()})
