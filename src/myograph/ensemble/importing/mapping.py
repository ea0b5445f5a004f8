"""The mapping: what the files of another program mean. Paths are relative to its folder."""

import string
from pathlib import Path

from pydantic import Field

from myograph.case import MUSCLES
from myograph.config import Model, read_toml
from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.errors import InputError
from myograph.fields import VOIGT

POINTS = "points"
"""The name of a file's points, where the name of an array is asked."""


class CasesMapping(Model):
    """The table of cases.

    Parameters
    ----------
    file
        CSV file, a row for each case.
    columns
        Our name -> its column. Names are the muscles, `hand_load_n`, `elbow_angle_deg` and `design`; those left out
        are columns of the same name, where there are such.
    absent
        Activation of the muscles that have no column; without it every muscle needs one.
    design
        The word of cases without a column `design`.
    """

    file: Path
    columns: dict[str, str] = Field(default_factory=dict)
    absent: float | None = Field(default=None, ge=0, le=1)
    design: str = Field(default="off_grid", min_length=1, max_length=16)


class MuscleMapping(Model):
    """The files of a muscle.

    Parameters
    ----------
    files
        Path with {case}, the number of the row from 0, as in 'biceps_{case:03d}.vtu', or with {COLUMN} of the table.
        Without any, one file (.npz, .vtkhdf) holds all cases in the rows' order.
    reference
        File of the reference body. Without it the body is made of the points of the first case.
    """

    files: str
    reference: Path | None = None


class ArrayMapping(Model):
    """A scalar: the name of its array."""

    array: str


class PositionMapping(ArrayMapping):
    """Where the nodes are: 'points', or an array of positions or displacements."""

    array: str = POINTS
    displacement: bool = False


class TensorMapping(ArrayMapping):
    """A symmetric tensor: the order of its six components; arrays of nine are full matrices, row by row."""

    order: tuple[str, str, str, str, str, str] = VOIGT


class FieldsMapping(Model):
    """Which arrays are which fields; those left out are not stored, but von Mises follows from the stress."""

    position: PositionMapping = PositionMapping()
    cauchy_stress: TensorMapping | None = None
    von_mises: ArrayMapping | None = None
    fibre_stretch: ArrayMapping | None = None
    pressure: ArrayMapping | None = None

    @property
    def stored(self) -> tuple[str, ...]:
        """Names of the fields that there will be."""
        given = {name for name in NODE_FIELDS if getattr(self, name) is not None}
        return tuple(name for name in NODE_FIELDS if name in given | ({"von_mises"} if self.cauchy_stress else set()))


class UnitsMapping(Model):
    """The files' units: how many mm, how many MPa one of them is."""

    length_mm: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    stress_mpa: float = Field(default=1.0, gt=0, allow_inf_nan=False)


class Mapping(Model):
    """All of it; `name` is a word for the data."""

    name: str = Field(min_length=1, max_length=60)
    cases: CasesMapping
    muscles: dict[str, MuscleMapping]
    fields: FieldsMapping = FieldsMapping()
    units: UnitsMapping = UnitsMapping()


def read_mapping(path: Path) -> Mapping:
    """The mapping of a file; raises InputError with file and key."""
    mapping = read_toml(path, Mapping)
    unknown = [name for name in mapping.muscles if name not in MUSCLES]
    if unknown or not mapping.muscles:
        raise InputError(f"{path}: muscles: expected some of {', '.join(MUSCLES)}, got {', '.join(unknown) or 'none'}")
    stress = mapping.fields.cauchy_stress
    if stress is not None and sorted(stress.order) != sorted(VOIGT):
        expected, got = ", ".join(VOIGT), ", ".join(stress.order)
        raise InputError(f"{path}: fields.cauchy_stress.order: expected {expected} in some order, got {got}")
    return mapping


def file_of(files: str, case: int, row: dict[str, str]) -> Path:
    """The file of a case; raises InputError for a name in braces that is neither `case` nor a column."""
    try:
        return Path(string.Formatter().vformat(files, (), {**row, "case": case}))
    except (KeyError, ValueError, IndexError, AttributeError) as problem:
        raise InputError(f"files '{files}': expected {{case}} or {{COLUMN}} of the table, got {problem}") from None


def holds_all(files: str) -> bool:
    """Whether one file holds all cases."""
    try:
        return all(name is None for _, name, _, _ in string.Formatter().parse(files))
    except ValueError as problem:
        raise InputError(f"files '{files}': {problem}") from None
