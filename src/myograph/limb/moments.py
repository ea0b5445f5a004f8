"""Moments about the elbow that no muscle makes: weights, and the joint's own stops.

A weight hangs from a forearm whose upper arm hangs straight down: its lever is the distance from the hinge times the
sine of the flexion, as in the published two-muscle model. Moments are positive in flexion, N*mm.
"""

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Load, Stops
from myograph.units import NEWTON_MM_PER_NEWTON_METRE, STANDARD_GRAVITY, radians

Angles = Float[np.ndarray, " points"]


@runtime_checkable
class OutsideMoment(Protocol):
    """Sum of all moments about a joint that no muscle makes."""

    def __call__(self, angles: Angles, hand_load: float, /) -> Angles:
        """Moments [N*mm] at angles [rad] with a weight [N] in the hand."""
        ...

    def gradient(self, angle: float, hand_load: float, /) -> tuple[float, float]:
        """Moment [N*mm] at one angle [rad], and its derivative [N*mm/rad]."""
        ...


def load_moment(load: Load, angle: Angles, hand_load: float, gravity: bool) -> Angles:
    """Moment of the weight in the hand [N] and, with `gravity`, of the forearm itself, at flexions [rad]."""
    return -_weight(load, hand_load, gravity) * np.sin(angle)


def stop_moment(stops: Stops, angle: Angles) -> Angles:
    """Moment of ligaments and soft tissue: linear beyond the stops, blended over a few degrees."""
    stiffness = stops.stiffness_nm * NEWTON_MM_PER_NEWTON_METRE
    softness = radians(stops.softness_deg)
    beyond_extension = _positive(radians(stops.extension_deg) - angle, softness)
    beyond_flexion = _positive(angle - radians(stops.flexion_deg), softness)
    return stiffness * (beyond_extension - beyond_flexion)


@dataclass(frozen=True)
class WeightsAndStops:
    """The outside moment of an arm.

    Parameters
    ----------
    stops
        None where nothing stops the joint.
    gravity
        Whether the forearm's own weight acts.
    """

    load: Load
    stops: Stops | None
    gravity: bool

    def __call__(self, angles: Angles, hand_load: float) -> Angles:
        """Moments [N*mm] at angles [rad] with a weight [N] in the hand."""
        weights = load_moment(self.load, angles, hand_load, self.gravity)
        return weights if self.stops is None else weights + stop_moment(self.stops, angles)

    def gradient(self, angle: float, hand_load: float) -> tuple[float, float]:
        """Moment [N*mm] at one angle [rad], and its derivative [N*mm/rad]; the same function as the call."""
        weight = _weight(self.load, hand_load, self.gravity)
        moment, slope = -weight * math.sin(angle), -weight * math.cos(angle)
        if self.stops is None:
            return moment, slope
        stiffness = self.stops.stiffness_nm * NEWTON_MM_PER_NEWTON_METRE
        softness = radians(self.stops.softness_deg)
        extension, share_e = _soft(radians(self.stops.extension_deg) - angle, softness)
        flexion, share_f = _soft(angle - radians(self.stops.flexion_deg), softness)
        return moment + stiffness * (extension - flexion), slope - stiffness * (share_e + share_f)


def _weight(load: Load, hand_load: float, gravity: bool) -> float:
    """Moment of all weights on a level forearm [N*mm]."""
    forearm = load.forearm_mass * STANDARD_GRAVITY * load.centre_of_mass if gravity else 0.0
    return hand_load * load.hand + forearm


def _positive(value: Angles, width: float) -> Angles:
    """Smooth positive part that vanishes quickly below zero."""
    return width * np.logaddexp(0.0, value / width)


def _soft(value: float, width: float) -> tuple[float, float]:
    """`_positive` of one number, and its derivative."""
    s = value / width
    decay = math.exp(-abs(s))
    return max(value, 0.0) + width * math.log1p(decay), (1.0 if s > 0 else decay) / (1.0 + decay)
