"""One muscle over the whole box of elbow angle and activation: tabulated states, smooth in between.

On disk a table is one `.npz` file of plain arrays; its key (arm, preset, grid, version of the format) says what it
was made from.
"""

import hashlib
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int, Shaped

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.errors import InputError, NotConvergedError
from myograph.fields import von_mises
from myograph.files import write_whole
from myograph.interpolation.tensor import TensorSpline
from myograph.units import radians

FORMAT = 2
FIELDS_IN_TABLE = ("position", "cauchy_stress", "fibre_stretch", "pressure")
_RECORDS = ("newton_steps", "volume_change", "smallest_jacobian", "penetration", "failures")


@dataclass(frozen=True)
class Grid:
    """Elbow angles [rad] and activations at which a muscle is solved, both increasing."""

    angles: tuple[float, ...]
    activations: tuple[float, ...]

    @property
    def size(self) -> int:
        """Number of states."""
        return len(self.angles) * len(self.activations)


def regular_grid(arm: Arm, angles: int, activations: int) -> Grid:
    """Equidistant grid over the arm's range of angles and over activations 0 to 1."""
    low, high = (radians(bound) for bound in arm.hinge.range_deg)
    return Grid(tuple(np.linspace(low, high, angles).tolist()), tuple(np.linspace(0, 1, activations).tolist()))


def table_key(arm: Arm, name: str, preset: str, grid: Grid) -> str:
    """Checksum of everything a table depends on."""
    text = json.dumps([FORMAT, arm_checksum(arm), name, preset, grid.angles, grid.activations])
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Record:
    """How each state was solved.

    Parameters
    ----------
    newton_steps
        Steps that each state took from its neighbour.
    volume_change, smallest_jacobian, penetration
        See `myograph.mechanics.soundness`; NaN where a state failed.
    failures
        Why a state failed; empty where it was solved.
    """

    newton_steps: Int[np.ndarray, "angles activations"]
    volume_change: Float[np.ndarray, "angles activations"]
    smallest_jacobian: Float[np.ndarray, "angles activations"]
    penetration: Float[np.ndarray, "angles activations"]
    failures: Shaped[np.ndarray, "angles activations"]


@dataclass(frozen=True)
class MuscleTable:
    """States of one muscle on a grid.

    Parameters
    ----------
    moments
        About the hinge [N*mm].
    fields
        Field name -> values over angles, activations, nodes (, components).
    reference
        Nodes in the reference body [mm].
    skin
        Quadrilaterals of the surface.
    record
        How each state was solved.
    """

    muscle: str
    key: str
    grid: Grid
    moments: Float[np.ndarray, "angles activations"]
    fields: Mapping[str, Float[np.ndarray, "angles activations nodes ..."]]
    reference: Float[np.ndarray, "nodes 3"]
    skin: Int[np.ndarray, "quads 4"]
    record: Record

    def require_complete(self) -> None:
        """Raise NotConvergedError, with the number of failed states and the first reason, unless all are there."""
        failed = np.argwhere(self.record.failures != "")
        if len(failed):
            first = self.record.failures[tuple(failed[0])]
            raise NotConvergedError(
                f"{self.muscle}: {len(failed)} of {self.grid.size} states failed; the first: {first}"
            )

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad] between the grid points."""
        return self._moment_spline(angles, activation)

    def at(self, angle: float, activation: float) -> dict[str, np.ndarray]:
        """All node fields between the grid points; von Mises from the interpolated stress."""
        values = {name: spline(angle, activation) for name, spline in self._field_splines.items()}
        return {**values, "von_mises": von_mises(values["cauchy_stress"])}

    @cached_property
    def _moment_spline(self) -> TensorSpline:
        self.require_complete()
        return TensorSpline(np.array(self.grid.angles), np.array(self.grid.activations), self.moments)

    @cached_property
    def _field_splines(self) -> dict[str, TensorSpline]:
        self.require_complete()
        angles, activations = np.array(self.grid.angles), np.array(self.grid.activations)
        return {name: TensorSpline(angles, activations, values) for name, values in self.fields.items()}


def save_table(table: MuscleTable, path: Path) -> None:
    """Write the table; the file appears whole or not at all."""
    arrays = {f"field_{name}": values for name, values in table.fields.items()}
    write_whole(
        path,
        lambda file: np.savez(
            file,
            muscle=np.array(table.muscle),
            key=np.array(table.key),
            angles=np.array(table.grid.angles),
            activations=np.array(table.grid.activations),
            moments=table.moments,
            reference=table.reference,
            skin=table.skin,
            allow_pickle=False,
            **{name: getattr(table.record, name) for name in _RECORDS},
            **arrays,
        ),
    )


def load_table(path: Path, key: str) -> MuscleTable:
    """Read a table made from exactly what `key` says; raise InputError where it is missing, damaged or another one."""
    try:
        with np.load(path, allow_pickle=False) as data:
            arrays = {name: data[name] for name in data.files}
        table = MuscleTable(
            muscle=str(arrays["muscle"]),
            key=str(arrays["key"]),
            grid=Grid(tuple(arrays["angles"].tolist()), tuple(arrays["activations"].tolist())),
            moments=arrays["moments"],
            fields={name: arrays[f"field_{name}"] for name in FIELDS_IN_TABLE},
            reference=arrays["reference"],
            skin=arrays["skin"],
            record=Record(**{name: arrays[name] for name in _RECORDS}),
        )
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as problem:
        raise InputError(f"{path}: not a readable muscle table ({problem}); delete it and tabulate anew") from None
    if table.key != key:
        raise InputError(f"{path}: made for another arm, preset, grid or version; delete it and tabulate anew")
    return table
