"""Where the arm is seen from, by name: angles around the side view of `myograph.view.scene.side_camera`."""

import numpy as np

from myograph.errors import InputError
from myograph.view.scene import Camera, side_camera

CAMERAS = {
    "oblique": (0.3, 0.12),
    "lateral": (0.0, 0.0),
    "front": (np.pi / 2, 0.0),
    "medial": (np.pi, 0.0),
    "back": (-np.pi / 2, 0.0),
    "above": (0.0, 1.2),
}
"""Name -> turn and tilt [rad]."""


def named_camera(name: str) -> Camera:
    """The viewer of that name; raises InputError for a name that is none."""
    if name not in CAMERAS:
        raise InputError(f"camera: expected one of {', '.join(CAMERAS)}, got '{name}'")
    return side_camera(*CAMERAS[name])
