"""How the insertion's face moves with the elbow.

Rigidly: its centre with the forearm, its orientation with the line of action (a face that turned with the forearm
would clamp the tendon in bending).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.anatomy.body import end_turn
from myograph.anatomy.hinge import Hinge
from myograph.anatomy.model import Muscle
from myograph.mesh.muscle_mesh import MuscleMesh


@dataclass(frozen=True)
class Insertion:
    """The moved face of one muscle."""

    muscle: Muscle
    hinge: Hinge
    mesh: MuscleMesh

    def displacement(self, flexion: float) -> Float[np.ndarray, "nodes 3"]:
        """Displacement [mm] of the face at a flexion [rad] from the reference pose; zero at all other nodes."""
        return self._spread(self._places(flexion) - self._places(0.0))

    def rate(self, flexion: float) -> Float[np.ndarray, "nodes 3"]:
        """Derivative of the displacement over the flexion [mm/rad]."""
        step = 1e-4
        return self._spread((self._places(flexion + step) - self._places(flexion - step)) / (2 * step))

    def _places(self, flexion: float) -> Float[np.ndarray, "face 3"]:
        face = self.mesh.points[self.mesh.end_nodes("insertion")]
        centre = self.mesh.end_centre("insertion")
        turn = self.hinge.rotation(end_turn(self.muscle, self.hinge, flexion))
        return self.hinge.flex(centre, flexion) + (face - centre) @ turn.T

    def _spread(self, moved: Float[np.ndarray, "face 3"]) -> Float[np.ndarray, "nodes 3"]:
        nodal = np.zeros_like(self.mesh.points)
        nodal[self.mesh.end_nodes("insertion")] = moved
        return nodal
