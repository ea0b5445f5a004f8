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
from myograph.materials.catalogue import AnyLaw
from myograph.units import radians

Point = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0)]
LARGEST_PRESTRETCH = 2.0
"""Fibres of living muscle rest below this; beyond it, the active fibre is far behind its optimum."""
BULK_OVER_TENDON_SHEAR = 20.0
"""Bulk over the tendon's shear modulus: at its strains of 3 per cent the volume then changes by 1.5e-3 at most."""
ATTACHED = 0.10
"""Share of a muscle's length, at either end, where it grows out of bone and bones do not push."""
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
    """Lengths of the free tendons along the line of action, and the width of their blend into the belly."""

    origin: Positive
    insertion: Positive
    blend: Positive


class Tissue(Model):
    """How the laws of belly and tendon make a muscle.

    With `bundles`, fibres carry the same force everywhere along the muscle: nominal stress times `pcsa` (the
    physiological cross-section of the unstretched belly) in the belly, times `tendon_area` in the tendon; and the
    matrix is stiffer where the section is under `full_area` [all mm²]. Without, stresses are as the laws say them.

    `prestretch` is the fibre's length in the reference body over its unstretched length; with `prestretch_matrix` the
    matrix is pre-stretched, too.
    """

    prestretch: float
    prestretch_matrix: bool = True
    bundles: bool = True
    pcsa: Positive
    tendon_area: Positive
    full_area: Positive

    @model_validator(mode="after")
    def _prestretch_is_one_of_living_muscle(self) -> "Tissue":
        if not 1 <= self.prestretch <= LARGEST_PRESTRETCH:
            raise ValueError(
                f"prestretch: expected 1 (none) to {LARGEST_PRESTRETCH:g}, the fibre's length in the reference body"
                f" over its unstretched length; got {self.prestretch:g}"
            )
        return self


class Band(Model):
    """Elastic band that keeps a piece of the muscle near the axis of a bone and lets it slide along it.

    `place` and `width` (half-width) are fractions of the muscle's length, `reach` the largest free distance of the
    skin from the bone's axis [mm], `stiffness` in N/mm³, `softness` the distance over which it becomes taut [mm].
    """

    bone: str
    place: Fraction
    width: Positive
    reach: Positive
    stiffness: Positive
    softness: Positive


class Contact(Model):
    """Rigid obstacles, a pulley about the hinge's axis [radius, mm] and bones by name; elastic bands.

    Stiffnesses in N/mm³: of bones `stiffness`, and on slim tendon `tendon_stiffness` more, which is also that of the
    pulley; `softness` [mm] is the gap within which an obstacle begins to push.
    """

    pulley: Annotated[float, Field(ge=0)] = 0.0
    tendon_stiffness: Positive = 8.0
    bones: tuple[str, ...] = ()
    stiffness: Positive = 0.5
    softness: Positive = 0.5
    bands: tuple[Band, ...] = ()


class Calibration(Model):
    """Where fitted parameters come from: relative L2 errors on the samples that were fitted and on those unseen."""

    source: str
    preset: str
    samples_fitted: Annotated[int, Field(gt=0)]
    samples_unseen: Annotated[int, Field(gt=0)]
    error_fitted: Positive
    error_unseen: Positive


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
    tissue: Tissue
    belly: AnyLaw
    tendon: AnyLaw
    contact: Contact = Contact()
    calibration: Calibration | None = None

    @model_validator(mode="after")
    def _areas_cover_the_length(self) -> "Muscle":
        places = [place for place, _ in self.areas]
        if len(places) < 2 or places[0] != 0 or places[-1] != 1 or any(b <= a for a, b in pairwise(places)):
            raise ValueError("areas: expected fractions that grow from 0 to 1")
        if self.origin == self.insertion:
            raise ValueError("origin and insertion are the same point: the fibres would have no length")
        return self

    @model_validator(mode="after")
    def _tendon_keeps_its_volume(self) -> "Muscle":
        bulk, shear = self.belly.bulk_modulus, self.tendon.shear_modulus
        if bulk < BULK_OVER_TENDON_SHEAR * shear:
            raise ValueError(
                f"belly: its bulk modulus holds in the tendon, too; expected at least {BULK_OVER_TENDON_SHEAR:g} times"
                f" the tendon's shear modulus of {shear:g} MPa, so that the tendon keeps its volume; got {bulk:g}, give"
                f" {BULK_OVER_TENDON_SHEAR * shear:g} MPa or more"
            )
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


class Dynamics(Model):
    """What movement needs beyond moments: inertia, damping, and how fast activation follows excitation.

    `radius_of_gyration` [mm] is that of the forearm with hand about its centre of mass, across the forearm; `damping`
    is the joint's, in N·m·s/rad; times in s.
    """

    radius_of_gyration: Positive
    damping_nms: Annotated[float, Field(ge=0)]
    activation_time: Positive
    deactivation_time: Positive


class Arm(Model):
    """A whole arm; `dynamics` only where it is to move."""

    name: str
    hinge: HingeSpec
    bones: dict[str, Bone]
    muscles: dict[str, Muscle]
    load: Load
    stops: Stops
    dynamics: Dynamics | None = None

    @model_validator(mode="after")
    def _names_are_known(self) -> "Arm":
        if set(self.muscles) != set(MUSCLES):
            raise ValueError(f"muscles: expected exactly {', '.join(MUSCLES)}, got {', '.join(self.muscles) or 'none'}")
        for name, muscle in self.muscles.items():
            for bone in (*muscle.contact.bones, *(band.bone for band in muscle.contact.bands)):
                if bone not in self.bones:
                    raise ValueError(f"muscles.{name}.contact: unknown bone '{bone}', expected {', '.join(self.bones)}")
        return self

    @property
    def reference_angle(self) -> float:
        """Flexion of the drawn pose [rad]."""
        return radians(self.hinge.reference_angle_deg)
