"""Several members of any method as one: their mean, and their spread as the standard deviation of each answer.

    mean = sum_k y_k / K,    deviation² = sum_k |y_k - mean|² / K

Source: Lakshminarayanan et al. 2017. Trap: members that agree may still all be wrong; `conformal` says by how much.
"""

from dataclasses import dataclass

import numpy as np

from myograph.ensemble.pairs.predictor import Learner, Predictor, Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.fields import FIELDS, von_mises

LEAST_MEMBERS = 2


@dataclass(frozen=True)
class EnsemblePredictor:
    """The mean of its members; raises InputError for fewer than two, or for members of different fields."""

    name: str
    members: tuple[Predictor, ...]

    def __post_init__(self) -> None:
        if len(self.members) < LEAST_MEMBERS:
            raise InputError(f"{self.name}: expected at least {LEAST_MEMBERS} members, got {len(self.members)}")
        if len({frozenset(member.fields) for member in self.members}) > 1:
            different = "; ".join(", ".join(member.fields) for member in self.members)
            raise InputError(f"{self.name}: expected members that answer the same fields, got {different}")

    @property
    def fields(self) -> tuple[str, ...]:
        """What it answers."""
        return self.members[0].fields

    def predict(self, question: Question) -> Answer:
        """Mean and spread; inside where all members that know say so."""
        answers = [member.predict(question) for member in self.members]
        values, deviation = {}, {}
        for name in self.fields:
            each = np.stack([answer.values[name] for answer in answers])
            values[name] = each.mean(axis=0)
            squares = np.square(each - values[name])
            deviation[name] = np.sqrt((squares.sum(axis=-1) if FIELDS[name].components else squares).mean(axis=0))
        if "cauchy_stress" in values and "von_mises" in values:
            values["von_mises"] = von_mises(values["cauchy_stress"])
        verdicts = [answer.inside for answer in answers if answer.inside is not None]
        return Answer(values, deviation, inside=np.logical_and.reduce(verdicts) if verdicts else None)


@dataclass(frozen=True)
class EnsembleLearner:
    """Learns all members one after the other, such as one method with several seeds."""

    members: tuple[Learner, ...]
    name: str = "deep_ensemble"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> EnsemblePredictor:
        """Fit every member to the same pairs."""
        return EnsemblePredictor(self.name, tuple(member.fit(sampler, split, progress) for member in self.members))
