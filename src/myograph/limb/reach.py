"""What a limb can do: the moments that its muscles can make at an angle, and the angles that it can hold.

Each muscle's moment is taken at equally spaced activations from 0 to 1; with independent muscles the sums of their
least and largest moments bound the net moment, and everything between is reached.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from myograph.limb.equilibrium import SCAN
from myograph.limb.limb import Limb
from myograph.units import degrees

LEVELS = 17
"""Activations at which a muscle's least and largest moments are sought."""


def moment_bounds(limb: Limb, angles: Float[np.ndarray, " points"]) -> Float[np.ndarray, "points 2"]:
    """Least and largest sum of the muscles' moments [N*mm] at angles [rad]."""
    levels = np.linspace(0, 1, LEVELS).tolist()
    bounds = np.zeros((len(angles), 2))
    for muscle in limb.muscles.values():
        moments = np.stack([muscle.moment(angles, level) for level in levels])
        bounds += np.stack([moments.min(axis=0), moments.max(axis=0)], axis=1)
    return bounds


def reachable_angles(limb: Limb, hand_load: float) -> tuple[tuple[float, float], ...]:
    """Intervals of angles [rad] at which some activations balance the load; found on a scan, ends interpolated."""
    angles = np.linspace(limb.low, limb.high, SCAN)
    needed = -limb.outside(angles, hand_load)
    bounds = moment_bounds(limb, angles)
    room = np.minimum(needed - bounds[:, 0], bounds[:, 1] - needed)
    inside = np.concatenate([[False], room >= 0, [False]]).astype(int)
    starts, ends = np.flatnonzero(np.diff(inside) == 1), np.flatnonzero(np.diff(inside) == -1) - 1
    return tuple(
        (_edge(angles, room, int(first), -1), _edge(angles, room, int(last), 1))
        for first, last in zip(starts, ends, strict=True)
    )


def in_words(intervals: Sequence[tuple[float, float]]) -> str:
    """The intervals in degrees."""
    return ", ".join(f"{degrees(low):.1f} to {degrees(high):.1f}" for low, high in intervals) or "none"


def _edge(angles: np.ndarray, room: np.ndarray, inner: int, step: int) -> float:
    """Where the room vanishes between a scanned angle inside and its neighbour outside."""
    outer = inner + step
    if not 0 <= outer < len(angles):
        return float(angles[inner])
    share = room[inner] / (room[inner] - room[outer])
    return float(angles[inner] + share * (angles[outer] - angles[inner]))
