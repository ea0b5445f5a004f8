"""What happened in a training, step by step."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from jaxtyping import Float

Stop = Literal["steps", "seconds", "patience"]
"""Why a training ended: all steps done, time over, no gain any more."""


@dataclass(frozen=True)
class History:
    """A training as it went.

    Parameters
    ----------
    loss
        Of each step [-].
    rmse
        Root mean square error of each step's batch [mm].
    rate
        Share of the largest rates in each step [-].
    validation
        Mean error on held-out pairs after each step [mm]; NaN where it was not measured.
    elapsed
        Time since the start at the end of each step [s]; what passed between a kill and the resumption does not count.
    stopped
        Why it ended.
    """

    loss: Float[np.ndarray, " steps"]
    rmse: Float[np.ndarray, " steps"]
    rate: Float[np.ndarray, " steps"]
    validation: Float[np.ndarray, " steps"]
    elapsed: Float[np.ndarray, " steps"]
    stopped: Stop

    @property
    def seconds(self) -> float:
        """Wall time of the training [s]."""
        return float(self.elapsed[-1])


@dataclass(frozen=True)
class StepRecord:
    """One step; see `History`."""

    loss: float
    rmse: float
    rate: float
    validation: float
    elapsed: float


COLUMNS = ("loss", "rmse", "rate", "validation", "elapsed")


@dataclass
class Course:
    """The steps so far."""

    records: list[StepRecord] = field(default_factory=list)

    def column(self, name: str) -> Float[np.ndarray, " steps"]:
        """One of COLUMNS."""
        return np.array([getattr(record, name) for record in self.records], dtype=np.float64)

    def fill(self, columns: dict[str, Float[np.ndarray, " steps"]]) -> None:
        """Take the steps from arrays by COLUMNS."""
        rows = zip(*(columns[name].tolist() for name in COLUMNS), strict=True)
        self.records = [StepRecord(*row) for row in rows]

    def history(self, stopped: Stop) -> History:
        """All steps, when no more will come."""
        columns = {name: self.column(name) for name in COLUMNS}
        return History(stopped=stopped, **columns)
