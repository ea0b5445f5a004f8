"""A movement so slow that the limb is at rest at every time.

From one time to the next the activations change along a straight line; the equilibrium is followed along it in steps
that are halved until the angle moves little. Where it still moves far in the smallest step, its branch has ended and
the limb jumps to another one, which is noted with its time.
"""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.limb.limb import Limb
from myograph.limb.motion.activation_file import Activations
from myograph.limb.motion.movement import Course, Movement, movement_of
from myograph.units import degrees, radians

STEP = radians(3.0)
"""Largest change of the angle in one step along a branch [rad]."""
SHORTEST = 2.0**-9
"""Shortest step, over the way from one time to the next."""


def follow_equilibria(limb: Limb, activations: Activations, hand_load: float, near: float) -> Movement:
    """An equilibrium at every time of the file; at the first time the one nearest to `near` [rad].

    Raises InputError, with the time, where there is none.
    """
    angles = np.zeros(len(activations.times))
    notes = list(activations.notes)
    previous = activations.values[0]
    angle = near
    for k, (time, values) in enumerate(zip(activations.times.tolist(), activations.values, strict=True)):
        try:
            if k == 0:
                angle = limb.rest(values.tolist(), hand_load, near).angle
            else:
                angle, jumps = _follow(limb, (previous, values), hand_load, angle)
                notes += [
                    f"jumps from {degrees(a):.1f} to {degrees(b):.1f} degrees before {time:g} s" for a, b in jumps
                ]
        except InputError as problem:
            raise InputError(f"at {time:g} s: {problem}") from None
        angles[k], previous = angle, values
    velocities = np.gradient(angles, activations.times)
    course = Course(activations.times, angles, velocities, activations.values, activations.values)
    return movement_of(limb, hand_load, "quasi-static", course, notes)


def _follow(
    limb: Limb,
    ends: tuple[Float[np.ndarray, " muscles"], Float[np.ndarray, " muscles"]],
    hand_load: float,
    angle: float,
) -> tuple[float, list[tuple[float, float]]]:
    """The angle at the second end, and the jumps on the way."""
    jumps = []
    done, step = 0.0, 1.0
    while done < 1.0:
        share = min(done + step, 1.0)
        there = limb.rest(((1 - share) * ends[0] + share * ends[1]).tolist(), hand_load, angle).angle
        if abs(there - angle) > STEP and step > SHORTEST:
            step /= 2
            continue
        if abs(there - angle) > STEP:
            jumps.append((angle, there))
        done, angle, step = share, there, 2 * step
    return angle, jumps
