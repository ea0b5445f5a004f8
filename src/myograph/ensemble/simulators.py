"""Simulators by name: what travels to a worker is a small spec; the simulator itself is made there, once.

    table              the arm from its tables, `TableArm`
    direct             the arm by finite elements, `DirectArm`; equilibria are sought from those of tables, if given
    package.module:f   your own: f(spec) returns a `Simulator` with an attribute `bodies`, muscle -> `Body`

A simulator whose answers depend on the cases before (warm starts) has a method `forget()` that makes it as new;
`remembers` says so. One that remembers and cannot forget is made anew.
"""

import importlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, Case, Simulator, Solution
from myograph.ensemble.spec import Body, SimulatorSpec
from myograph.errors import InputError, MissingPackageError, MyographError
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.folder import load_tables
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.unknowns import interpolated_unknowns
from myograph.mesh.presets import preset_mesh

BUILT_IN = ("table", "direct")
IMPORT = "import"
"""What stands for the simulator of imported data; nothing can make it."""


@runtime_checkable
class OwnSimulator(Protocol):
    """What a factory of your own returns: a `Simulator` that knows its bodies."""

    @property
    def bodies(self) -> Mapping[str, Body]:
        """Muscle -> reference body."""
        ...

    def __call__(self, case: Case) -> Solution:
        """Answer the case."""
        ...


def read_arm(spec: SimulatorSpec) -> Arm:
    """The arm of a spec."""
    return Arm.model_validate_json(spec.arm)


def make_simulator(spec: SimulatorSpec) -> Simulator:
    """The simulator; raises InputError where something it needs is not there."""
    if spec.kind == "table":
        arm = read_arm(spec)
        return TableArm(arm, _tables(spec, arm), spec.gravity)
    if spec.kind == "direct":
        try:
            from myograph.limb.direct_arm import DirectArm
        except ModuleNotFoundError as missing:
            raise MissingPackageError(str(missing.name), "simulate", "solving muscles") from None
        arm = read_arm(spec)
        if spec.tables is None:
            return DirectArm(arm, spec.preset, gravity=spec.gravity)
        tables = _tables(spec, arm)
        return DirectArm.beside_tables(Path(spec.tables), arm, tables, spec.preset, gravity=spec.gravity)
    return _own(spec)


def make_bodies(spec: SimulatorSpec) -> dict[str, Body]:
    """The reference bodies that belong to the simulator's fields, by muscle."""
    if spec.kind in BUILT_IN:
        arm = read_arm(spec)
        meshes = {name: preset_mesh(arm, name, spec.preset) for name in MUSCLES}
        return {name: Body(mesh.points, mesh.skin, mesh.cells) for name, mesh in meshes.items()}
    return dict(_own(spec).bodies)


def describe_simulator(spec: SimulatorSpec) -> dict[str, Any]:
    """All that the answers depend on, not where it lies; raises InputError for tables of another arm or preset."""
    arm = read_arm(spec)
    described = {
        "kind": spec.kind,
        "preset": spec.preset,
        "arm_checksum": arm_checksum(arm),
        "gravity": spec.gravity,
        "tables": {},
    }
    if spec.kind == "table" or (spec.kind == "direct" and spec.tables is not None):
        tables = _tables(spec, arm)
        described["tables"] = {name: table.key for name, table in tables.items()}
        if spec.kind == "direct":
            described["starts"] = list(interpolated_unknowns(Path(str(spec.tables)), arm, tables, spec.preset))
    return described


def made_anew(simulator: Simulator, spec: SimulatorSpec) -> Simulator:
    """The simulator as if it had not been asked yet."""
    if not spec.remembers:
        return simulator
    forget = getattr(simulator, "forget", None)
    if forget is None:
        return make_simulator(spec)
    forget()
    return simulator


def _tables(spec: SimulatorSpec, arm: Arm) -> dict[str, MuscleTable]:
    if spec.tables is None:
        raise InputError("simulator 'table': expected a folder of tables; make one with 'myograph table build'")
    return load_tables(Path(spec.tables), arm, spec.preset if spec.kind == "table" else None)


def _own(spec: SimulatorSpec) -> OwnSimulator:
    if spec.kind == IMPORT:
        raise InputError("imported data cannot be computed again: import them again, with 'myograph dataset import'")
    module, _, name = spec.kind.partition(":")
    if not module or not name.isidentifier():
        raise InputError(f"simulator: expected 'table', 'direct' or 'package.module:function', got '{spec.kind}'")
    try:
        factory: Callable[[SimulatorSpec], Any] = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError) as problem:
        raise InputError(f"simulator '{spec.kind}': cannot be imported: {problem}") from None
    try:
        simulator: Any = factory(spec)
    except MyographError:
        raise
    except Exception as problem:
        raise InputError(f"simulator '{spec.kind}': {type(problem).__name__}: {problem}") from None
    if not isinstance(simulator, OwnSimulator):
        raise InputError(f"simulator '{spec.kind}': expected a callable with 'bodies', got {type(simulator).__name__}")
    return simulator
