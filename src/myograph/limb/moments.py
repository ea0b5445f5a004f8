"""Moments about the elbow that no muscle makes: weights, and the joint's own stops.

A weight hangs from a forearm whose upper arm hangs straight down: its lever is the distance from the hinge times the
sine of the flexion, as in the published two-muscle model. Moments are positive in flexion, N*mm.
"""

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Load, Stops
from myograph.units import NEWTON_MM_PER_NEWTON_METRE, STANDARD_GRAVITY, radians

Angles = Float[np.ndarray, " points"]


def load_moment(load: Load, angle: Angles, hand_load: float, gravity: bool) -> Angles:
    """Moment of the weight in the hand [N] and, with `gravity`, of the forearm itself, at flexions [rad]."""
    forearm = load.forearm_mass * STANDARD_GRAVITY * load.centre_of_mass if gravity else 0.0
    return -(hand_load * load.hand + forearm) * np.sin(angle)


def stop_moment(stops: Stops, angle: Angles) -> Angles:
    """Moment of ligaments and soft tissue: linear beyond the stops, blended over a few degrees."""
    stiffness = stops.stiffness_nm * NEWTON_MM_PER_NEWTON_METRE
    softness = radians(stops.softness_deg)
    beyond_extension = _positive(radians(stops.extension_deg) - angle, softness)
    beyond_flexion = _positive(angle - radians(stops.flexion_deg), softness)
    return stiffness * (beyond_extension - beyond_flexion)


def _positive(value: Angles, width: float) -> Angles:
    """Smooth positive part that vanishes quickly below zero."""
    return width * np.logaddexp(0.0, value / width)
