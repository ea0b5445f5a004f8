"""Muscles and limbs from formulas, for tests at joint level."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from myograph.anatomy.model import Load, Stops
from myograph.interpolation import Domain, Hierarchizer, SparseGrid, basis
from myograph.limb.limb import Limb
from myograph.limb.moments import WeightsAndStops
from myograph.limb.spline_moment import SplineMoment

LOAD = Load(forearm_mass=1.5, centre_of_mass=180.0, hand=280.0)
STOPS = Stops(extension_deg=25.0, flexion_deg=112.0, stiffness_nm=150.0, softness_deg=3.0)
LOW, HIGH = (float(angle) for angle in np.radians([10.0, 150.0]))


@dataclass(frozen=True)
class Formula:
    """M = strength (share(a) + rest) shape(θ), by functions and their derivatives."""

    strength: float
    shape: Any
    slope: Any
    share: Any = lambda a: a
    share_slope: Any = lambda a: 1.0
    rest: float = 0.2

    def moment(self, angles, activation):
        return self.strength * (self.share(activation) + self.rest) * (self.shape(angles) + 0 * angles)

    def moment_gradient(self, angle, activation):
        level = self.share(activation) + self.rest
        return (
            float(self.strength * level * self.shape(angle)),
            float(self.strength * level * self.slope(angle)),
            float(self.strength * self.share_slope(activation) * self.shape(angle)),
        )


@dataclass(frozen=True)
class Constant:
    """An outside moment and its slope: c + k θ - hand_load."""

    c: float
    k: float = 0.0

    def __call__(self, angles, hand_load):
        return self.c + self.k * angles - hand_load

    def gradient(self, angle, hand_load):
        return self.c + self.k * angle - hand_load, self.k


def spline_muscle(strength, level=5):
    """A muscle from a sparse-grid spline of strength (0.2 + a) cos(θ / 2)."""
    domain = Domain(np.array([LOW, 0.0]), np.array([HIGH, 1.0]))
    splines = Hierarchizer(SparseGrid.regular(2, level), basis("modified_clenshaw_curtis", 3), domain)
    angle, activation = splines.points.T
    return SplineMoment(splines.interpolant(strength * (0.2 + activation) * np.cos(angle / 2)))


def five_muscles():
    """Five splines about an elbow with load, stops and gravity."""
    strengths = {"brachioradialis": 5e3, "brachialis": 8e3, "biceps": 2e4, "anconeus": -1e3, "triceps": -2e4}
    muscles = {name: spline_muscle(strength) for name, strength in strengths.items()}
    return Limb(muscles, WeightsAndStops(LOAD, STOPS, True), LOW, HIGH)


def two_muscles():
    """A flexor that weakens as the elbow bends and an extensor: one stable equilibrium for every activation."""
    flexor = Formula(2e4, lambda t: np.cos(t / 2), lambda t: -np.sin(t / 2) / 2)
    extensor = Formula(-2e4, lambda t: 0.5 + 0.2 * np.sin(t), lambda t: 0.2 * np.cos(t))
    return Limb({"flexor": flexor, "extensor": extensor}, WeightsAndStops(LOAD, STOPS, False), LOW, HIGH)
