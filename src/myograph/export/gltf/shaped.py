"""A muscle as a mean shape and morph targets: its first modes, each times its largest amount in the movement.

Positions are linear in the targets' weights, and so as exact as the modes. Normals are not: each target has the change
of the normals along it, and viewers make the sum of unit length again.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.export.gltf.frame import METRES, normals_of, placed, triangles_of, turned
from myograph.inference.low_rank import LowRankMuscle

SMALLEST = 1e-6
"""Largest amount of a target [mm], at least: a muscle may rest in the whole movement."""


@dataclass(frozen=True)
class Keys:
    """A movement.

    Parameters
    ----------
    times
        Increasing [s].
    activations, hand_load
        At each of them [-], and the same all the time [N].
    """

    times: Float[np.ndarray, " times"]
    activations: Float[np.ndarray, "times muscles"]
    hand_load: float


@dataclass(frozen=True)
class Shaped:
    """A muscle in the frame of glTF [m].

    Parameters
    ----------
    colour
        '#rrggbb'.
    targets, target_normals
        What each target adds at a weight of one.
    weights
        Of the targets, at the movement's times.
    error_mm
        Largest distance of a node from all modes together, over the movement.
    """

    name: str
    colour: str
    points: Float[np.ndarray, "nodes 3"]
    normals: Float[np.ndarray, "nodes 3"]
    triangles: Int[np.ndarray, "triangles 3"]
    targets: Float[np.ndarray, "targets nodes 3"]
    target_normals: Float[np.ndarray, "targets nodes 3"]
    weights: Float[np.ndarray, "times targets"]
    error_mm: float


def shaped_muscle(
    muscle: LowRankMuscle, keys: Keys, count: int, centre: Float[np.ndarray, " 3"], colour: str
) -> Shaped:
    """The muscle with at most that many targets.

    Raises InputError for fewer than one, and for a model that does not know the surface of its body.
    """
    if count < 1:
        raise InputError(f"morph targets: expected at least 1, got {count}")
    if not len(muscle.skin):
        raise InputError(f"{muscle.name}: expected a model that knows the surface of its body, got one without")
    nodes, skin = np.unique(muscle.skin, return_inverse=True)
    triangles = triangles_of(skin.reshape(muscle.skin.shape))
    field = muscle.fields["position"]
    places = [muscle.place(row, keys.hand_load) for row in keys.activations]
    amounts = np.stack([field.amounts(place.x, place.u) for place in places])
    modes = field.modes[:, nodes]
    largest = np.maximum(np.abs(amounts[:, :count]).max(axis=0), SMALLEST)
    steps = largest[:, None, None] * modes[:count]
    mean = field.mean[nodes]
    normals = normals_of(mean, triangles)
    along = np.stack([normals_of(mean + step, triangles) - normals for step in steps])
    left_out = np.tensordot(amounts[:, count:], modes[count:], axes=1)
    return Shaped(
        name=muscle.muscle,
        colour=colour,
        points=placed(mean, centre),
        normals=turned(normals),
        triangles=triangles,
        targets=METRES * turned(steps),
        target_normals=turned(along),
        weights=amounts[:, :count] / largest,
        error_mm=float(np.linalg.norm(left_out, axis=-1).max()),
    )


def elbow_angles(muscles: Sequence[LowRankMuscle], keys: Keys) -> Float[np.ndarray, " times"] | None:
    """Of the arm [rad] at the movement's times; None where the models do not know it."""
    found = [muscles[0].elbow_angle(row, keys.hand_load) for row in keys.activations]
    return None if any(angle is None for angle in found) else np.array(found, dtype=float)
