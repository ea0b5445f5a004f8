"""Where a muscle is belly and where it is tendon, blended smoothly."""

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm, Tendons
from myograph.mesh.muscle_mesh import MuscleMesh


def muscle_fraction(along: Float[np.ndarray, " nodes"], length: float, tendons: Tendons) -> Float[np.ndarray, " nodes"]:
    """Smooth share of muscle, 0 in the free tendons, 1 in the belly; always within [0, 1].

    Parameters
    ----------
    along
        Fraction of the length from the origin.
    length
        Length of the muscle's centre line [mm].
    """
    from_origin = (along * length - tendons.origin) / tendons.blend + 0.5
    from_insertion = ((1 - along) * length - tendons.insertion) / tendons.blend + 0.5
    ramp = np.clip(np.minimum(from_origin, from_insertion), 0, 1)
    return ramp**2 * (3 - 2 * ramp)


def tendon_share(arm: Arm, name: str, mesh: MuscleMesh) -> Float[np.ndarray, " nodes"]:
    """Fraction of tendon at each node of the named muscle."""
    return 1 - muscle_fraction(mesh.along, mesh.length, arm.muscles[name].tendons)
