"""Limbs of tabulated forces from files: a TOML file that names tables of samples and lever arms.

The TOML file gives the range of angles, the weights and, for each muscle, a column of a table and a lever arm
(docs/limb.md has an example). The table is text with a header: columns separated by commas or blanks, a `#` before the
header or before comments is allowed.
"""

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from jaxtyping import Float
from numpy.polynomial import Polynomial
from pydantic import Field, model_validator

from myograph.anatomy.model import Dynamics, Load, Positive, Stops
from myograph.config import Model, read_toml
from myograph.errors import InputError
from myograph.limb.forces import TabulatedForce, tabulated_force
from myograph.limb.limb import Limb
from myograph.limb.moments import WeightsAndStops
from myograph.units import radians


class MuscleColumn(Model):
    """One muscle: which column of which table its tension is, and its lever arm.

    `lever_mm` are coefficients of 1, θ, θ², … with θ in degrees; the tension is `scale` times the column [N].
    """

    samples: Path
    column: str
    angle_deg: str = "angle_deg"
    activation: str = "activation"
    acts: Literal["flexes", "extends"]
    scale: float = 1.0
    lever_mm: Annotated[tuple[float, ...], Field(min_length=1)]


class HandWeight(Model):
    """Distance of the weight in the hand from the hinge [mm]; mass [kg] and centre of mass [mm] of a forearm."""

    hand: Positive
    forearm_mass: Positive | None = None
    centre_of_mass: Positive | None = None

    @model_validator(mode="after")
    def _a_mass_is_somewhere(self) -> "HandWeight":
        if (self.forearm_mass is None) != (self.centre_of_mass is None):
            raise ValueError("expected forearm_mass and centre_of_mass together, got one of them")
        return self


class ForceLimb(Model):
    """A limb of tabulated forces, as its file says it."""

    name: str
    range_deg: tuple[float, float]
    load: HandWeight
    muscles: Annotated[dict[str, MuscleColumn], Field(min_length=1)]
    stops: Stops | None = None
    dynamics: Dynamics | None = None

    @model_validator(mode="after")
    def _the_range_increases(self) -> "ForceLimb":
        if not self.range_deg[0] < self.range_deg[1]:
            raise ValueError(f"range_deg: expected increasing angles, got {self.range_deg}")
        return self

    @property
    def weights(self) -> Load | None:
        """Load with the forearm's mass; None where the file gives none."""
        if self.load.forearm_mass is None or self.load.centre_of_mass is None:
            return None
        return Load(forearm_mass=self.load.forearm_mass, centre_of_mass=self.load.centre_of_mass, hand=self.load.hand)


def read_force_limb(path: Path) -> ForceLimb:
    """The file's contents; tables are relative to its folder. Raises InputError with file and key."""
    return read_toml(path, ForceLimb)


def limb_from_forces(spec: ForceLimb, folder: Path, gravity: bool = True) -> Limb:
    """The limb that the file says; `folder` is where its tables are.

    With `gravity`, the forearm's own weight acts if the file gives a mass. Raises InputError with the table and the
    muscle where they do not fit.
    """
    low, high = (radians(bound) for bound in spec.range_deg)
    muscles = {name: _muscle(name, column, folder, (low, high)) for name, column in spec.muscles.items()}
    massless = Load(forearm_mass=1.0, centre_of_mass=1.0, hand=spec.load.hand)
    heavy = spec.weights if gravity else None
    return Limb(muscles, WeightsAndStops(heavy or massless, spec.stops, heavy is not None), low, high)


def _muscle(name: str, spec: MuscleColumn, folder: Path, angle_range: tuple[float, float]) -> TabulatedForce:
    path = folder / spec.samples
    columns = read_table(path, (spec.angle_deg, spec.activation, spec.column))
    samples = columns * np.array([radians(1.0), 1.0, spec.scale])
    sign = 1.0 if spec.acts == "flexes" else -1.0
    try:
        return tabulated_force(samples, angle_range, sign * Polynomial(spec.lever_mm))
    except InputError as problem:
        raise InputError(f"{path}, muscle '{name}': {problem}") from None


def read_table(path: Path, wanted: tuple[str, ...]) -> Float[np.ndarray, "rows columns"]:
    """The wanted columns of a text table with a header; raises InputError with file and line."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as problem:
        raise InputError(f"{path}: cannot be read as text ({problem})") from None
    rows = [(number, _cells(line.lstrip("# \t"))) for number, line in enumerate(lines, 1) if line.strip("# \t")]
    if len(rows) < 2:
        raise InputError(f"{path}: expected a header and rows of numbers, got {len(rows)} lines")
    header = rows[0][1]
    for name in wanted:
        if name not in header:
            raise InputError(f"{path}: expected a column '{name}', got {', '.join(header)}")
    places = [header.index(name) for name in wanted]
    numbers = []
    for number, cells in rows[1:]:
        if lines[number - 1].lstrip().startswith("#"):
            continue
        if len(cells) != len(header):
            raise InputError(f"{path}, line {number}: expected {len(header)} numbers, got {len(cells)}")
        try:
            numbers.append([float(cells[place]) for place in places])
        except ValueError as problem:
            raise InputError(f"{path}, line {number}: {problem}") from None
    return np.array(numbers).reshape(-1, len(wanted))


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split(",")] if "," in line else line.split()
