"""A new store: its plan, its empty arrays and the muscles' reference bodies; there as a whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
import zarr
from jaxtyping import Int

from myograph.ensemble.design.cases import Design
from myograph.ensemble.pairs.sampler import SENSORS, random_sensors
from myograph.ensemble.simulators import describe_simulator, make_bodies
from myograph.ensemble.spec import Body, SimulatorSpec
from myograph.ensemble.store.arrays import add_field
from myograph.ensemble.store.aside import ASIDE
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.plan import PLAN, SCHEMA, StorePlan, plan_bytes, read_plan
from myograph.ensemble.store.provenance import PROVENANCE, provenance_bytes
from myograph.ensemble.store.rows import ROWS
from myograph.ensemble.store.tables import note
from myograph.errors import InputError


def plan_store(design: Design, simulator: SimulatorSpec, muscles: Sequence[str]) -> tuple[StorePlan, dict[str, Body]]:
    """What a store of these cases holds; raises InputError for muscles that the simulator does not know."""
    bodies = make_bodies(simulator)
    require_muscles(muscles, bodies)
    chosen = {name: bodies[name] for name in dict.fromkeys(muscles)}
    nodes = {name: len(body.reference) for name, body in chosen.items()}
    return StorePlan(design, simulator, describe_simulator(simulator), tuple(chosen), nodes, {}), chosen


def require_muscles(asked: Sequence[str], known: Iterable[str]) -> None:
    """Raise InputError unless there are some muscles, and all of them are known."""
    names = tuple(known)
    if not asked or any(name not in names for name in asked):
        raise InputError(f"muscles: expected some of {', '.join(names)}, got {', '.join(asked) or 'none'}")


def plan_at(path: Path) -> StorePlan | None:
    """The plan of the store at a path, None where a new one can be made.

    Raises InputError for a folder of something else, and for the one that the shell stands in: a new store would take
    its place.
    """
    if path.exists() and (not path.is_dir() or any(path.iterdir())):
        return read_plan(path)
    if path.resolve() == Path.cwd():
        raise InputError(f"{path}: expected another folder than the one you are in; give the new store a name")
    return None


def make_store(path: Path, plan: StorePlan, bodies: Mapping[str, Body], provenance: Mapping[str, str]) -> StorePlan:
    """The store at a path: a new one, or the one that is there, if it asks the same.

    Raises InputError for a store of another design, for a folder of something else, and where there is no room.
    """
    found = plan_at(path)
    if found is not None and found.identity != plan.identity:
        raise InputError(
            f"{path}: holds {_difference(found, plan)}; take another folder, or run it with what it was made with"
        )
    if found is not None:
        return found
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        aside = Path(tempfile.mkdtemp(prefix=f".{path.name}-", dir=path.parent))
    except OSError as problem:
        raise InputError(f"{path}: cannot be written ({problem.strerror})") from None
    try:
        _fill(aside, plan, bodies, {**provenance, **note(path, plan.simulator.tables)})
        aside.chmod(0o755)
        os.replace(aside, path)
    except OSError as problem:
        raise InputError(f"{path}: cannot be written ({problem.strerror}); free some room") from None
    finally:
        shutil.rmtree(aside, ignore_errors=True)
    return read_plan(path)


def _fill(folder: Path, plan: StorePlan, bodies: Mapping[str, Body], provenance: Mapping[str, str]) -> None:
    write_still(folder, plan, bodies)
    (folder / ROWS).mkdir()
    (folder / ASIDE).mkdir()
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    still = {path.relative_to(folder).as_posix(): checksum(path.read_bytes()) for path in files}
    (folder / PROVENANCE).write_bytes(provenance_bytes(provenance))
    (folder / PLAN).write_bytes(plan_bytes(plan.with_still(still)))


def write_still(folder: Path, plan: StorePlan, bodies: Mapping[str, Body]) -> None:
    """The Zarr groups and all that never changes in them."""
    root = zarr.open_group(folder, mode="w", attributes={"schema": SCHEMA, "identity": plan.identity})
    for muscle in plan.muscles:
        described = {"muscle": muscle, "simulator": plan.simulator.kind, "preset": plan.simulator.preset}
        checked = {"arm_checksum": plan.described["arm_checksum"], "schema": SCHEMA}
        group = root.create_group(muscle, attributes={**described, **checked})
        for field in plan.fields:
            add_field(group, field, plan.size, plan.nodes[muscle])
        body = bodies[muscle]
        _add(group, "reference_position", body.reference.astype("<f8"), ("nodes", "axes"), "mm")
        _add(group, "surface_quads", body.skin.astype("<i8"), ("facets", "corners"), "1")
        _add(group, "connectivity", body.cells.astype("<i8"), ("cells", "cell_nodes"), "1")
        _add(group, "sensor_nodes", sensor_nodes(plan.nodes[muscle]), ("sensors",), "1")


def sensor_nodes(nodes: int) -> Int[np.ndarray, " sensors"]:
    """The nodes of the standard sensors; on a body of no more nodes than these, all of them but one."""
    return random_sensors(nodes, min(SENSORS, nodes - 1)).astype("<i8")


def _add(group: zarr.Group, name: str, values: np.ndarray, names: tuple[str, ...], unit: str) -> None:
    array = group.create_array(
        name, shape=values.shape, dtype=values.dtype, dimension_names=names, attributes={"units": unit}
    )
    array[...] = values


def _difference(found: StorePlan, asked: StorePlan) -> str:
    if found.design != asked.design:
        return f"another design ({found.size} cases, asked for {asked.size})"
    if found.muscles != asked.muscles:
        return f"other muscles ({', '.join(found.muscles)}; asked for {', '.join(asked.muscles)})"
    for key, value in found.described.items():
        if asked.described.get(key) != value:
            return f"answers of another simulator ({key}: {value}; asked for {asked.described.get(key)})"
    return "meshes of another size"
