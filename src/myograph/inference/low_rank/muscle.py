"""A muscle whose fields are known wherever the arm's activations and load are: all of it plain arrays."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.case import MUSCLES, check_activation
from myograph.errors import InputError
from myograph.fields import von_mises
from myograph.inference.low_rank.angle import AngleNetwork
from myograph.inference.low_rank.field import RANGE, LowRankField
from myograph.inference.model_file import TrainedRange

Activation = Float[np.ndarray, " muscles"]
SMALLEST = 1e-6
"""Von Mises stress [MPa] below which its direction is not defined."""


@dataclass(frozen=True)
class Place:
    """Where a muscle is on the surface of its shapes, and the standard deviations of both numbers."""

    x: float
    u: float
    x_deviation: float
    u_deviation: float


@dataclass(frozen=True)
class LowRankMuscle:
    """A muscle.

    Parameters
    ----------
    name, muscle
        Of the model; of the muscle.
    own
        Index of its activation in `myograph.MUSCLES`.
    fields
        By name, 'position' first.
    angle
        From activations and load to x.
    most_x
        Largest |x| that the model lets its networks say.
    own_deviation
        Standard deviation of u.
    reference, skin, cells
        Of the body: material coordinates [mm], nodes of the surface's quadrilaterals, nodes of the elements.
    trained_range, half_width_90
        As in `myograph.inference.model_file.ModelFile`, the latter where activations alone are told.
    checksum
        SHA-256 of the model's weights.
    """

    name: str
    muscle: str
    own: int
    fields: Mapping[str, LowRankField]
    angle: AngleNetwork
    most_x: float
    own_deviation: float
    reference: Float[np.ndarray, "nodes 3"]
    skin: Int[np.ndarray, "facets 4"]
    cells: Int[np.ndarray, "cells n"]
    trained_range: TrainedRange
    half_width_90: Mapping[str, float]
    checksum: str

    def place(self, activation: Activation, hand_load: float = 0.0) -> Place:
        """Where these activations of all five muscles and this load [N] put the muscle.

        Raises InputError for another number of activations, for one outside [0, 1], and for a load that is no number.
        """
        told = _checked(activation, hand_load)
        x, deviation = self.angle.x(told, float(hand_load))
        x = float(np.clip(x, -self.most_x, self.most_x))
        return Place(x, RANGE * (2 * float(told[self.own]) - 1), deviation, self.own_deviation)

    def at(self, activation: Activation, hand_load: float = 0.0) -> dict[str, Float[np.ndarray, "nodes ..."]]:
        """Fields at all nodes, by name; Cauchy stress brings von Mises stress along. Raises as `place` does."""
        return self.at_place(self.place(activation, hand_load))

    def at_place(self, place: Place) -> dict[str, Float[np.ndarray, "nodes ..."]]:
        """Fields at all nodes of a muscle at this place."""
        found = {}
        for name, field in self.fields.items():
            values = field.values(field.amounts(place.x, place.u))
            found[name] = values if field.components > 1 else values[:, 0]
        if "cauchy_stress" in found:
            found["von_mises"] = von_mises(found["cauchy_stress"])
        return found

    def deviations(self, place: Place) -> dict[str, Float[np.ndarray, " nodes"]]:
        """Standard deviation of the position [mm] and of von Mises stress [MPa] at all nodes."""
        found = {}
        for name, field in self.fields.items():
            along_x, along_u = field.slopes(place.x, place.u)
            steps = along_x * place.x_deviation, along_u * place.u_deviation
            changes = [field.changes(step) for step in steps]
            if name == "position":
                squares = sum(np.square(change).sum(axis=1) for change in changes)
                found[name] = np.sqrt(squares + np.square(field.misfit))
            elif name == "cauchy_stress":
                stress = field.values(field.amounts(place.x, place.u))
                squares = sum(np.square(_von_mises_change(stress, change)) for change in changes)
                found["von_mises"] = np.sqrt(squares + np.square(field.misfit))
            elif name == "von_mises":
                squares = sum(np.square(change[:, 0]) for change in changes)
                found[name] = np.sqrt(squares + np.square(field.misfit))
        return found

    def elbow_angle(self, activation: Activation, hand_load: float = 0.0) -> float | None:
        """The elbow's angle [rad]; None where the model does not know it. Raises as `place` does."""
        return self.angle.angle(self.place(activation, hand_load).x)

    def inside(self, activation: Activation, hand_load: float = 0.0) -> bool:
        """Whether activations and load lie within what the model was trained on."""
        trained = self.trained_range
        low, high = np.array(trained.activation_low) - 1e-6, np.array(trained.activation_high) + 1e-6
        slack = 1e-6 * max(1.0, *(abs(load) for load in trained.hand_load))
        loaded = trained.hand_load[0] - slack <= hand_load <= trained.hand_load[1] + slack
        return bool(loaded and ((activation >= low) & (activation <= high)).all())


def _checked(activation: Activation, hand_load: float) -> Activation:
    if len(activation) != len(MUSCLES):
        raise InputError(f"expected {len(MUSCLES)} activations ({', '.join(MUSCLES)}), got {len(activation)}")
    if not np.isfinite(hand_load):
        raise InputError(f"load at the hand: expected a number of newtons, got {hand_load!r}")
    return np.array([check_activation(value, name) for value, name in zip(activation.tolist(), MUSCLES, strict=True)])


def _von_mises_change(
    stress: Float[np.ndarray, "nodes 6"], change: Float[np.ndarray, "nodes 6"]
) -> Float[np.ndarray, " nodes"]:
    """What a small change of the stress changes [MPa]: B(σ, dσ) / σ_v, of the product B that σ_v² = B(σ, σ) is."""
    normal = (stress[:, :3] - np.roll(stress[:, :3], -1, axis=1)) * (change[:, :3] - np.roll(change[:, :3], -1, axis=1))
    product = normal.sum(axis=1) / 2 + 3 * (stress[:, 3:] * change[:, 3:]).sum(axis=1)
    return product / np.maximum(von_mises(stress), SMALLEST)
