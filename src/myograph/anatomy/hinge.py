"""The elbow as a hinge, and its plane of flexion.

In the plane, the first coordinate points forwards, the second upwards, the origin is the hinge; the lateral
coordinate runs along the hinge's axis. Flexion turns counter-clockwise, that is about minus the axis of the built-in
arm.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True)
class Hinge:
    """A fixed axis with the frame of its plane.

    Parameters
    ----------
    point
        A point on the axis [mm].
    forward, up, axis
        Orthonormal directions; `axis` is lateral.
    """

    point: Float[np.ndarray, " 3"]
    forward: Float[np.ndarray, " 3"]
    up: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]

    def to_plane(self, points: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
        """Coordinates (forward, up, lateral) relative to the hinge [mm]."""
        return (points - self.point) @ np.stack([self.forward, self.up, self.axis], axis=1)

    def from_plane(self, coordinates: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
        """Points in space [mm] of coordinates (forward, up, lateral)."""
        return coordinates @ np.stack([self.forward, self.up, self.axis]) + self.point

    def rotation(self, angle: float) -> Float[np.ndarray, "3 3"]:
        """Matrix in space that flexes by `angle` [rad]: turns forward towards up."""
        c, s = np.cos(angle), np.sin(angle)
        frame = np.stack([self.forward, self.up, self.axis])
        return frame.T @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]) @ frame

    def flex(self, points: Float[np.ndarray, "*batch 3"], angle: float) -> Float[np.ndarray, "*batch 3"]:
        """Points that move with the forearm, after a flexion by `angle` [rad]."""
        return (points - self.point) @ self.rotation(angle).T + self.point


def hinge_frame(point: tuple[float, ...], axis: tuple[float, ...]) -> Hinge:
    """Hinge through `point` [mm] along a horizontal `axis`; up is z, forward makes the frame.

    forward = up x axis for an axis that points to the right of somebody who looks forwards.
    """
    lateral = np.array(axis, dtype=float) / np.linalg.norm(axis)
    up = np.array([0.0, 0.0, 1.0])
    up = up - (up @ lateral) * lateral
    up /= np.linalg.norm(up)
    return Hinge(np.array(point, dtype=float), np.cross(lateral, up), up, lateral)
