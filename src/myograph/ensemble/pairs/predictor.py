"""What can answer questions about pairs, and what can learn to: networks, baselines and tables alike."""

from collections.abc import Callable
from typing import Protocol, runtime_checkable

from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler

Progress = Callable[[int, int, float], None]
"""Called after each step with its number from 1, the number of steps, and the step's root mean square error [mm]."""


@runtime_checkable
class Predictor(Protocol):
    """Answers questions about the body that it was fitted to."""

    @property
    def name(self) -> str:
        """As it stands in tables."""
        ...

    @property
    def fields(self) -> tuple[str, ...]:
        """What it answers; 'position' among them, or not."""
        ...

    def predict(self, question: Question) -> Answer:
        """Answer; raises InputError for a question that lacks what the method needs."""
        ...


@runtime_checkable
class Learner(Protocol):
    """A method before it has seen data: holds its settings only."""

    @property
    def name(self) -> str:
        """As it stands in tables."""
        ...

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> Predictor:
        """Learn from the split's training pairs; nothing of its other cases is looked at.

        Raises InputError where these are not enough.
        """
        ...
