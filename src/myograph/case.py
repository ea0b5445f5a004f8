"""The one verb of the package: a `Case` is asked, a `Simulator` answers with a `Solution`.

The finite-element arm, its table and every trained network are Simulators; whoever looks at results never knows which
of them answered.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np

from myograph.errors import InputError

MUSCLES = ("brachioradialis", "brachialis", "biceps", "anconeus", "triceps")
"""The muscles that move the elbow, in the order of every activation vector."""


def check_activation(value: float, muscle: str) -> float:
    """Return the activation; raise InputError unless it is a number in [0, 1]."""
    if not math.isfinite(value) or not 0 <= value <= 1:
        raise InputError(f"activation of {muscle}: expected a number in [0, 1], got {value!r}")
    return float(value)


def check_muscle(name: str) -> str:
    """Return the name; raise InputError with the known names where it is none of them."""
    if name not in MUSCLES:
        raise InputError(f"unknown muscle '{name}': expected one of {', '.join(MUSCLES)}")
    return name


@dataclass(frozen=True)
class Case:
    """What is asked of an arm.

    Parameters
    ----------
    activations
        One number in [0, 1] per muscle, in the order of `MUSCLES`.
    hand_load
        Weight held in the hand [N]; acts downwards.
    elbow_angle
        Prescribed elbow flexion [rad]; None lets the arm find its equilibrium.
    """

    activations: tuple[float, ...]
    hand_load: float = 0.0
    elbow_angle: float | None = None

    def __post_init__(self) -> None:
        if len(self.activations) != len(MUSCLES):
            raise InputError(f"expected {len(MUSCLES)} activations ({', '.join(MUSCLES)}), got {len(self.activations)}")
        checked = tuple(check_activation(a, m) for a, m in zip(self.activations, MUSCLES, strict=True))
        object.__setattr__(self, "activations", checked)
        if not math.isfinite(self.hand_load):
            raise InputError(f"load at the hand: expected a number of newtons, got {self.hand_load!r}")
        if self.elbow_angle is not None and not math.isfinite(self.elbow_angle):
            raise InputError(f"elbow angle: expected a finite number or none, got {self.elbow_angle!r}")


@dataclass(frozen=True)
class Solution:
    """What an arm answers.

    Parameters
    ----------
    case
        The question.
    elbow_angle
        Elbow flexion [rad].
    moments
        Moment of each muscle about the hinge [N*mm]; positive = flexion.
    fields
        Muscle name -> field name (see `myograph.fields`) -> array (nodes, components) or (nodes,).
    origin
        Who answered: 'direct' (finite elements), 'table', or the name of a model.
    notes
        How far to trust it, in words; empty where there is nothing to say.
    """

    case: Case
    elbow_angle: float
    moments: Mapping[str, float]
    fields: Mapping[str, Mapping[str, np.ndarray]]
    origin: str
    notes: tuple[str, ...] = field(default=())


@runtime_checkable
class Simulator(Protocol):
    """Anything that answers a Case with a Solution."""

    def __call__(self, case: Case) -> Solution:
        """Answer the case; raises InputError or NotConvergedError where it cannot."""
        ...
