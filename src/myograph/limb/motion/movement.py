"""A movement: the state of a limb over time, however it was found.

Angles in rad and moments in N*mm inside; degrees and N·m in the CSV file, whose header names them.
"""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
from jaxtyping import Float

from myograph.case import MUSCLES, Case
from myograph.errors import InputError
from myograph.files import write_whole
from myograph.limb.limb import Limb
from myograph.units import NEWTON_MM_PER_NEWTON_METRE


@dataclass(frozen=True)
class Movement:
    """Time series of a limb.

    Parameters
    ----------
    kind
        'quasi-static' (at rest at every time) or 'dynamic'.
    times
        Increasing [s].
    angles, velocities
        Elbow flexion [rad] and its rate [rad/s].
    excitations, activations
        What is asked of each muscle and what it has [-]; the same in a quasi-static movement.
    muscle_moments, outside_moments
        Moments [N*mm] of the muscles and of all that is none (weights, stops, without damping).
    notes
        What to know about it, with times.
    """

    kind: Literal["quasi-static", "dynamic"]
    muscles: tuple[str, ...]
    hand_load: float
    times: Float[np.ndarray, " times"]
    angles: Float[np.ndarray, " times"]
    velocities: Float[np.ndarray, " times"]
    excitations: Float[np.ndarray, "times muscles"]
    activations: Float[np.ndarray, "times muscles"]
    muscle_moments: Float[np.ndarray, "times muscles"]
    outside_moments: Float[np.ndarray, " times"]
    notes: tuple[str, ...] = field(default=())

    def case(self, k: int) -> Case:
        """The question whose fields belong to time k: activations, load, and the angle as it was.

        Raises InputError unless the limb has the arm's own muscles.
        """
        if self.muscles != MUSCLES:
            raise InputError(
                f"fields of a movement: expected the muscles {', '.join(MUSCLES)}, got {', '.join(self.muscles)}"
            )
        return Case(tuple(self.activations[k].tolist()), self.hand_load, float(self.angles[k]))


@dataclass(frozen=True)
class Course:
    """Where a limb was: what `movement_of` needs beside the limb; shapes as in `Movement`."""

    times: Float[np.ndarray, " times"]
    angles: Float[np.ndarray, " times"]
    velocities: Float[np.ndarray, " times"]
    excitations: Float[np.ndarray, "times muscles"]
    activations: Float[np.ndarray, "times muscles"]


def movement_of(
    limb: Limb, hand_load: float, kind: Literal["quasi-static", "dynamic"], course: Course, notes: Sequence[str]
) -> Movement:
    """The movement of a course, with its moments."""
    states = list(zip(course.activations.tolist(), course.angles[:, None], strict=True))
    moments = np.concatenate([limb.muscle_moments(activations, angle) for activations, angle in states])
    outside = limb.outside(course.angles, hand_load)
    return Movement(kind, limb.names, hand_load, **vars(course), muscle_moments=moments, outside_moments=outside,
                    notes=tuple(notes))  # fmt: skip


def save_movement(movement: Movement, path: Path) -> None:
    """Write a CSV file, a row per time; it appears whole or not at all."""
    names, in_nm = movement.muscles, 1 / NEWTON_MM_PER_NEWTON_METRE
    blocks = {
        "time_s": movement.times,
        "angle_deg": np.degrees(movement.angles),
        "velocity_deg_s": np.degrees(movement.velocities),
        **{f"excitation_{name}": column for name, column in zip(names, movement.excitations.T, strict=True)},
        **{f"activation_{name}": column for name, column in zip(names, movement.activations.T, strict=True)},
        **{f"moment_nm_{name}": in_nm * column for name, column in zip(names, movement.muscle_moments.T, strict=True)},
        "outside_moment_nm": in_nm * movement.outside_moments,
    }
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(blocks)
    writer.writerows([f"{value:.9g}" for value in row] for row in np.stack(list(blocks.values()), axis=1).tolist())
    write_whole(path, lambda file: file.write(text.getvalue().encode()))
