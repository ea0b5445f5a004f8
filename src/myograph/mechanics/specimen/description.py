"""What a specimen is and what is done to it: frozen, checked when it is written down.

Convention: displacements in mm from the reference body; dead tractions per reference area [MPa], fixed in direction;
a follower pressure [MPa] pushes on the deformed face, along its inward normal.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from myograph.case import check_activation
from myograph.errors import InputError
from myograph.materials.law import Law
from myograph.mechanics.specimen.shapes import Shape, Vector

Components = tuple[float | None, float | None, float | None]
Gradient = tuple[Vector, Vector, Vector]

_UNIT = 1e-6
"""Largest deviation of a fibre direction's length from one."""


@dataclass(frozen=True)
class Specimen:
    """A piece of one material, and the planes that it is mirrored on.

    Parameters
    ----------
    shape
        Box, Panel, ThickCylinder or ThickSphere.
    law
        Any material law.
    fibre
        Unit direction in the reference body [-]; its sign has no meaning, and laws without fibres ignore it.
    symmetry
        Plane faces that keep to their plane.
    element
        'hexahedra' (Q2 displacement, Q1 pressure) or 'tetrahedra' (P2, P1; six in place of each hexahedron).

    Raises
    ------
    InputError
        For a fibre that is no unit vector, or a face that is no plane across an axis.
    """

    shape: Shape
    law: Law
    fibre: Vector = (1.0, 0.0, 0.0)
    symmetry: tuple[str, ...] = ("x_min", "y_min", "z_min")
    element: Literal["hexahedra", "tetrahedra"] = "hexahedra"

    def __post_init__(self) -> None:
        length = math.hypot(*self.fibre)
        if not abs(length - 1) < _UNIT:
            raise InputError(f"fibre direction: expected a unit vector, got {self.fibre!r} of length {length:g}")
        _require_known("plane of symmetry", self.symmetry, sorted(self.shape.planes))


@dataclass(frozen=True)
class Load:
    """What is done to a specimen.

    Parameters
    ----------
    displacement
        Face -> prescribed components x, y, z [mm]; None where a component is free.
    gradient
        Deformation gradient F that the whole boundary follows, u = (F - 1) X; None where it does not.
    activation
        From 0 to 1.
    traction
        Face -> dead force per reference area [MPa].
    pressure
        Face -> follower pressure [MPa]; positive pushes the face inwards.

    Raises
    ------
    InputError
        For numbers that are not finite, an activation outside [0, 1], a gradient that turns the body inside out, or a
        gradient beside displacements.
    """

    displacement: Mapping[str, Components] = field(default_factory=dict)
    gradient: Gradient | None = None
    activation: float = 0.0
    traction: Mapping[str, Vector] = field(default_factory=dict)
    pressure: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_activation(self.activation, "the specimen")
        for face, components in self.displacement.items():
            _require_finite(f"displacement of {face} [mm]", [c for c in components if c is not None])
        for face, traction in self.traction.items():
            _require_finite(f"traction on {face} [MPa]", traction)
        for face, pressure in self.pressure.items():
            _require_finite(f"pressure on {face} [MPa]", (pressure,))
        if self.gradient is not None and self.displacement:
            raise InputError("gradient: it prescribes the whole boundary, so expected no displacement beside it")
        if self.gradient is not None and not np.linalg.det(np.array(self.gradient)) > 0:
            raise InputError(f"gradient: expected a positive determinant, got {self.gradient!r}")


def check_faces(load: Load, faces: Sequence[str]) -> None:
    """Raise InputError for a load on a face that the body does not have."""
    for what, named in (
        ("displacement", load.displacement),
        ("traction", load.traction),
        ("pressure", load.pressure),
    ):
        _require_known(f"face of the {what}", named, faces)


def _require_known(what: str, names: Sequence[str] | Mapping[str, object], known: Sequence[str]) -> None:
    for name in names:
        if name not in known:
            raise InputError(f"unknown {what} '{name}': expected one of {', '.join(known)}")


def _require_finite(what: str, values: Sequence[float]) -> None:
    if not all(math.isfinite(value) for value in values):
        raise InputError(f"{what}: expected finite numbers, got {tuple(values)!r}")
