"""The one list of field names: unit, shape, where a field lives, what it means.

Tensors are symmetric and written in Voigt order xx yy zz yz xz xy. Stress is Cauchy stress.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

VOIGT = ("xx", "yy", "zz", "yz", "xz", "xy")
AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Field:
    """One quantity: its unit, the names of its components (none for a scalar), where it lives, its meaning."""

    name: str
    unit: str
    components: tuple[str, ...]
    lives_on: Literal["nodes", "cells", "cases", "muscles"]
    meaning: str


_ALL = (
    Field("reference_position", "mm", AXES, "nodes", "material coordinates X: names a piece of tissue for ever"),
    Field("position", "mm", AXES, "nodes", "where the piece of tissue is now"),
    Field("cauchy_stress", "MPa", VOIGT, "nodes", "Cauchy stress, averaged over the elements around the node"),
    Field("von_mises", "MPa", (), "nodes", "von Mises stress (maximum distortion criterion)"),
    Field("fibre_stretch", "1", (), "nodes", "length of the fibre over its length in the reference body"),
    Field("pressure", "MPa", (), "nodes", "multiplier of the volume constraint; positive = tension"),
    Field("activation", "1", (), "muscles", "fraction of the largest active fibre force"),
    Field("moment", "N*mm", (), "muscles", "moment of the muscle about the hinge; positive = flexion"),
    Field("elbow_angle", "rad", (), "cases", "elbow flexion; 0 = straight arm"),
    Field("hand_load", "N", (), "cases", "weight held in the hand"),
)
FIELDS: dict[str, Field] = {field.name: field for field in _ALL}


def value_shape(name: str) -> tuple[int, ...]:
    """What stands behind (cases, nodes) in the shape of a known field: nothing, or its number of components."""
    components = FIELDS[name].components
    return (len(components),) if components else ()


def von_mises(stress: Float[np.ndarray, "*batch 6"]) -> Float[np.ndarray, "*batch"]:
    """Von Mises stress [MPa] of a Cauchy stress in Voigt order.

    sigma_v² = ((xx-yy)² + (yy-zz)² + (zz-xx)²)/2 + 3 (yz² + xz² + xy²).
    """
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(normal / 2 + 3 * (yz**2 + xz**2 + xy**2))
