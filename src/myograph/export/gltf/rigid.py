"""A body that does not deform, such as a bone, and how it turns."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.export.gltf.frame import turned


@dataclass(frozen=True)
class Turning:
    """About a hinge.

    Parameters
    ----------
    axis
        Unit direction in the arm's frame; a positive angle turns by the right hand about it.
    angles
        At the movement's times [rad], from the pose in which the bodies are drawn.
    """

    axis: Float[np.ndarray, " 3"]
    angles: Float[np.ndarray, " times"]

    @property
    def quaternions(self) -> Float[np.ndarray, "times 4"]:
        """x, y, z, w in the frame of glTF; neighbours in time have no opposite signs."""
        half = self.angles[:, None] / 2
        return np.concatenate([np.sin(half) * turned(self.axis), np.cos(half)], axis=1)


@dataclass(frozen=True)
class Rigid:
    """A body.

    Parameters
    ----------
    points, quads
        Of its surface in the arm's frame [mm]; outward normals.
    moves
        Whether it turns with the forearm.
    """

    name: str
    colour: str
    points: Float[np.ndarray, "nodes 3"]
    quads: Int[np.ndarray, "facets 4"]
    moves: bool
