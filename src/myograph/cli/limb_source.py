"""The limb that a verb works with: the arm from its tables, or tabulated forces from a file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from myograph.anatomy.model import Dynamics, Load
from myograph.cli.options import read_arm
from myograph.errors import InputError
from myograph.limb.force_limb import limb_from_forces, read_force_limb
from myograph.limb.limb import Limb
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.folder import load_tables

Tables = Annotated[
    Path | None, typer.Option("--tables", help="Folder of the arm's tables, from 'myograph table build'.")
]
LimbFile = Annotated[
    Path | None, typer.Option("--limb", help="TOML file of a limb of tabulated forces, instead of the arm's tables.")
]
Gravity = Annotated[bool, typer.Option("--gravity/--no-gravity", help="Whether the forearm's own weight acts.")]


@dataclass(frozen=True)
class LimbSource:
    """A limb and what its source says beyond moments.

    Parameters
    ----------
    name
        For people.
    near
        Angle [rad] from which equilibria are sought.
    dynamics, load
        None where the source has none.
    arm
        The arm whose fields can be drawn; None for a limb of forces.
    """

    name: str
    limb: Limb
    near: float
    dynamics: Dynamics | None
    load: Load | None
    arm: TableArm | None


@dataclass(frozen=True)
class Asked:
    """Options of a verb that say which limb: tables of an arm (None: the built-in one), or a file of forces."""

    tables: Path | None
    limb_file: Path | None
    arm_file: Path | None
    gravity: bool


def read_source(asked: Asked) -> LimbSource:
    """The limb that was asked for; raises InputError unless there is exactly one, and readable."""
    if (asked.tables is None) == (asked.limb_file is None):
        raise InputError(
            "expected either --tables FOLDER (made by 'myograph table build') or --limb FILE.toml, got"
            f" {'none' if asked.tables is None else 'both'}"
        )
    if asked.limb_file is not None:
        if asked.arm_file is not None:
            raise InputError("expected --arm together with --tables only, got it with --limb")
        spec = read_force_limb(asked.limb_file)
        limb = limb_from_forces(spec, asked.limb_file.parent, asked.gravity)
        return LimbSource(spec.name, limb, (limb.low + limb.high) / 2, spec.dynamics, spec.weights, None)
    assert asked.tables is not None
    simulator = read_table_arm(asked.tables, asked.arm_file, asked.gravity)
    arm = simulator.arm
    return LimbSource(arm.name, simulator.limb, arm.reference_angle, arm.dynamics, arm.load, simulator)


def read_table_arm(tables: Path, arm_file: Path | None, gravity: bool) -> TableArm:
    """The arm of the file, or the built-in one, from its tables in a folder; raises as `load_tables` does."""
    arm = read_arm(arm_file)
    return TableArm(arm, load_tables(tables, arm), gravity)
