"""What an arm is: hinge, bones, muscles, materials; read from TOML, checked once, then frozen.

Lengths in mm, forces in N, stresses in MPa; angles in degrees where the name says so.
"""

from itertools import pairwise
from typing import Annotated, Literal

import numpy as np
from jaxtyping import Float
from pydantic import Field, model_validator
from scipy.interpolate import PchipInterpolator

from myograph.anatomy.hinge import Hinge, hinge_frame
from myograph.case import MUSCLES
from myograph.config import Model
from myograph.units import radians

Point = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0)]
Fraction = Annotated[float, Field(ge=0, le=1)]


class HingeSpec(Model):
    """The elbow: a fixed axis, the flexion of the drawn pose, and the range that may be asked for."""

    point: Point
    axis: Point
    reference_angle_deg: float
    range_deg: tuple[float, float]

    def frame(self) -> Hinge:
        """The hinge with the directions of its plane."""
        return hinge_frame(self.point, self.axis)


class Bone(Model):
    """A rigid capsule; a bone of the forearm turns with the hinge."""

    start: Point
    end: Point
    radius: Positive
    moves_with: Literal["upper arm", "forearm"]


class Tendons(Model):
    """Lengths of the free tendons along the line of action, the width of their blend into the belly, their stiffness.

    The tendon's force is quadratic in its strain up to `toe` and linear beyond; `stiffness` is the slope there [N].
    """

    origin: Positive
    insertion: Positive
    blend: Positive
    stiffness: Positive
    toe: Positive


class Fibre(Model):
    """Force of the whole bundle of belly fibres over their stretch l, with l_t = prestretch * l.

    T = passive_force * pos(l_t - 1)^passive_exponent + activation * active_force * f(l_t / optimal_stretch - 1),
    pos(e) = (e + sqrt(e² + toe²)) / 2, f a Gauss bell with its own width on either side of the optimum.
    """

    prestretch: Positive
    passive_force: Positive
    passive_exponent: Annotated[float, Field(ge=1)]
    toe: Positive
    active_force: Positive
    optimal_stretch: Positive
    width_ascending: Positive
    width_descending: Positive


class Matrix(Model):
    """Mooney–Rivlin ground substance [MPa]; the belly's stiffness grows where the section is under `full_area`
    [mm²]."""

    c1: Positive
    c2: Annotated[float, Field(ge=0)]
    tendon_c1: Positive
    bulk: Positive
    full_area: Positive


class Band(Model):
    """Elastic band that keeps a piece of the muscle near the forearm's axis and lets it slide along it.

    `place` and `width` (half-width) are fractions of the muscle's length, `reach` the largest free distance of the
    skin from the axis [mm], `stiffness` in N/mm³.
    """

    place: Fraction
    width: Positive
    reach: Positive
    stiffness: Positive
    softness: Positive = 2.0


class Contact(Model):
    """Rigid obstacles: a pulley about the hinge's axis, bones by name; bands; stiffness in N/mm³ at `full_area` mm²."""

    pulley: Annotated[float, Field(ge=0)] = 0.0
    bones: tuple[str, ...] = ()
    bands: tuple[Band, ...] = ()
    stiffness: Positive = 1.0
    softness: Positive = 1.0
    full_area: Positive = 50.0


class Muscle(Model):
    """One muscle: its line of action in the reference pose, its sections, its material, its obstacles.

    `areas` are (fraction of the length from the origin, mm²); `bow` moves the middle of the belly off the line of
    action, away from the hinge in the plane (forwards for a muscle in front), `bow_lateral` sideways.
    """

    origin: Point
    insertion: Point
    side: Literal["front", "back"]
    line_radius: Annotated[float, Field(ge=0)]
    via: Point | None = None
    bow: float = 0.0
    bow_lateral: float = 0.0
    areas: tuple[tuple[Fraction, Positive], ...]
    flattening: Positive = 1.0
    tendons: Tendons
    fibre: Fibre
    matrix: Matrix
    contact: Contact = Contact()

    @model_validator(mode="after")
    def _areas_cover_the_length(self) -> "Muscle":
        places = [place for place, _ in self.areas]
        if len(places) < 2 or places[0] != 0 or places[-1] != 1 or any(b <= a for a, b in pairwise(places)):
            raise ValueError("areas: expected fractions that grow from 0 to 1")
        if self.origin == self.insertion:
            raise ValueError("origin and insertion are the same point: the fibres would have no length")
        return self

    def section_area(self, along: Float[np.ndarray, " places"]) -> Float[np.ndarray, " places"]:
        """Section area [mm²] at fractions of the length."""
        places, areas = np.array(self.areas).T
        return PchipInterpolator(places, areas)(along)


class Load(Model):
    """The forearm with the hand as a weight: mass [kg], distances from the hinge along the forearm [mm]."""

    forearm_mass: Positive
    centre_of_mass: Positive
    hand: Positive


class Stops(Model):
    """Passive moment of the joint's ligaments: stiffness [N·m/rad] times a smooth overshoot beyond the two angles."""

    extension_deg: float
    flexion_deg: float
    stiffness_nm: Positive
    softness_deg: Positive


class Arm(Model):
    """A whole arm."""

    name: str
    hinge: HingeSpec
    bones: dict[str, Bone]
    muscles: dict[str, Muscle]
    load: Load
    stops: Stops

    @model_validator(mode="after")
    def _names_are_known(self) -> "Arm":
        if set(self.muscles) != set(MUSCLES):
            raise ValueError(f"muscles: expected exactly {', '.join(MUSCLES)}, got {', '.join(self.muscles) or 'none'}")
        for name, muscle in self.muscles.items():
            for bone in muscle.contact.bones:
                if bone not in self.bones:
                    raise ValueError(f"muscles.{name}.contact.bones: unknown bone '{bone}'")
        return self

    @property
    def reference_angle(self) -> float:
        """Flexion of the drawn pose [rad]."""
        return radians(self.hinge.reference_angle_deg)
