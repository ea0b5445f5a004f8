"""Methods whose errors are known."""

from dataclasses import dataclass

import numpy as np

from myograph.ensemble.pairs.question import Answer


@dataclass(frozen=True)
class Guesser:
    """Is off the initial positions by a fixed distance along x; says what deviation and verdict it is told."""

    off: float
    deviation: float | None = None
    inside: bool | None = None
    fields: tuple[str, ...] = ("position",)
    name: str = "guesser"

    def fit(self, sampler, split, progress=None):
        return self

    def predict(self, question):
        values = {"position": question.query_initial["position"] + [self.off, 0, 0]}
        shape = values["position"].shape[:2]
        return Answer(
            values,
            {} if self.deviation is None else {"position": np.full(shape, self.deviation)},
            inside=None if self.inside is None else np.full(question.size, self.inside),
        )


@dataclass(frozen=True)
class Stresser:
    """Answers the initial Cauchy stress, scaled."""

    scale: float
    fields: tuple[str, ...] = ("cauchy_stress", "von_mises")
    name: str = "stresser"

    def predict(self, question):
        return Answer(
            {
                "cauchy_stress": self.scale * question.query_initial["cauchy_stress"],
                "von_mises": abs(self.scale) * question.query_initial["von_mises"],
            }
        )
