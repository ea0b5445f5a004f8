"""How far a table is off: states at random points, solved and not interpolated.

The building of a table stops when these errors are within its tolerances, so they are a little on the good side; they
never choose where the grid is refined.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Shaped

from myograph.limb.tables.state import State
from myograph.units import newton_metres


@dataclass(frozen=True, eq=False)
class HeldOut:
    """Errors at the held-out points; NaN where nothing could be measured.

    Parameters
    ----------
    points
        (angle [rad], activation).
    mean_mm, max_mm
        Distances of the nodes [mm] from where they should be.
    moment_nm
        Absolute error of the moment [N·m].
    failures
        Why a state failed; empty where it was solved.
    """

    points: Float[np.ndarray, "held_out 2"]
    mean_mm: Float[np.ndarray, " held_out"]
    max_mm: Float[np.ndarray, " held_out"]
    moment_nm: Float[np.ndarray, " held_out"]
    failures: Shaped[np.ndarray, " held_out"]

    @classmethod
    def none(cls) -> "HeldOut":
        """Nobody measured."""
        empty = np.empty(0)
        return cls(np.empty((0, 2)), empty, empty, empty, np.empty(0, dtype=str))

    def within(self, tolerance_mm: float, tolerance_nm: float) -> bool:
        """Whether all were solved, and the means over them are at most the tolerances."""
        return bool(self.mean_mm.mean() <= tolerance_mm and self.moment_nm.mean() <= tolerance_nm)

    def summary(self) -> dict[str, float | None]:
        """Means and largest errors over the measured states; None where there are none."""
        solved = np.isfinite(self.mean_mm)
        if not solved.any():
            return dict.fromkeys(("mean_mm", "max_mm", "moment_mean_nm", "moment_max_nm"))
        return {
            "mean_mm": float(self.mean_mm[solved].mean()),
            "max_mm": float(self.max_mm[solved].max()),
            "moment_mean_nm": float(self.moment_nm[solved].mean()),
            "moment_max_nm": float(self.moment_nm[solved].max()),
        }


@runtime_checkable
class Table(Protocol):
    """What is measured."""

    def field(self, name: str, angle: float, activation: float, /) -> Float[np.ndarray, "nodes ..."]:
        """A node field at an angle [rad]."""
        ...

    def moment(self, angles: Float[np.ndarray, " points"], activation: float, /) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad]."""
        ...


def measured(states: Sequence[State], table: Table | None) -> HeldOut:
    """Errors of a table at the places of the states; NaN where a state failed, or all without a table."""
    rows = []
    for state in states:
        if state.failure or table is None:
            rows.append((np.nan, np.nan, np.nan))
            continue
        position = table.field("position", state.angle, state.activation)
        distances = np.linalg.norm(position - state.fields["position"], axis=1)
        moment = float(table.moment(np.array([state.angle]), state.activation)[0])
        rows.append((float(distances.mean()), float(distances.max()), abs(newton_metres(moment - state.moment))))
    mean_mm, max_mm, moment_nm = np.array(rows).reshape(-1, 3).T.copy()
    points = np.array([(state.angle, state.activation) for state in states]).reshape(-1, 2)
    return HeldOut(points, mean_mm, max_mm, moment_nm, np.array([state.failure for state in states], dtype=str))
