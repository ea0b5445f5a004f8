"""Fields over time as a VTKHDF file, which ParaView (5.12 and newer) and PyVista open as it is.

One unstructured grid of all muscles, the data set `muscle` of its elements says which is which. The points move: every
step has its own; `reference_position` and the elements are stored once, and `displacement` is the way from there.
Symmetric tensors are in VTK's order xx yy zz xy yz xz, so that ParaView names their components rightly. float32,
not compressed, which would save a hundredth of the size. Units are attributes of the data sets; the numbers of a step,
such as activations, are its field data.
Source: docs.vtk.org, "VTKHDF File Format", version 2.0, transient unstructured grid.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from myograph.ensemble.spec import Body
from myograph.errors import InputError, MissingPackageError
from myograph.export.grid import Grid, grid_of
from myograph.export.steps import Step
from myograph.export.target import write_place
from myograph.fields import FIELDS, VOIGT

SIGNATURE = b"\x89HDF\r\n\x1a\n"
VTK_TENSOR = ("xx", "yy", "zz", "xy", "yz", "xz")
_ORDER = [VOIGT.index(name) for name in VTK_TENSOR]
_STILL = "reference_position"


def write_vtkhdf(path: Path, bodies: Mapping[str, Body], steps: Iterable[Step]) -> int:
    """Write the steps one after the other; gives back how many there were.

    Raises InputError for no step, for steps whose fields differ or do not fit the bodies, and where the file cannot
    be written; MissingPackageError without h5py.
    """
    try:
        import h5py
    except ModuleNotFoundError:
        raise MissingPackageError("h5py", "export", "writing VTKHDF") from None
    grid, count = grid_of(bodies), 0

    def fill(place: Path) -> None:
        nonlocal count
        with h5py.File(place, "w") as file:
            count = _fill(file, grid, bodies, steps)

    write_place(path, SIGNATURE, fill)
    return count


def _fill(file: Any, grid: Grid, bodies: Mapping[str, Body], steps: Iterable[Step]) -> int:
    root = file.create_group("VTKHDF", track_order=True)
    root.attrs["Version"] = (2, 0)
    root.attrs["Type"] = np.bytes_("UnstructuredGrid")
    writer = _Writer(root, grid, bodies)
    for step in steps:
        writer.add(step)
    writer.end()
    return len(writer.times)


class _Writer:
    """The data sets of a file that grows by a step at a time; nothing else stays in memory."""

    def __init__(self, root: Any, grid: Grid, bodies: Mapping[str, Body]) -> None:
        self._root, self._grid, self._bodies = root, grid, bodies
        self.times: list[float] = []
        self._names: dict[str, set[str]] = {}
        self._numbers: dict[str, int] = {}
        self._still()

    def _still(self) -> None:
        """What all steps share."""
        grid, root = self._grid, self._root
        root["NumberOfPoints"] = np.array([len(grid.points)])
        root["NumberOfCells"] = np.array([len(grid.types)])
        root["NumberOfConnectivityIds"] = np.array([len(grid.connectivity)])
        root["Connectivity"], root["Offsets"], root["Types"] = grid.connectivity, grid.offsets, grid.types
        root.create_group("CellData")["muscle"] = grid.muscle
        root["CellData/muscle"].attrs["meanings"] = list(grid.muscles)
        root.create_group("PointData")
        root.create_group("FieldData")
        self._grow(f"PointData/{_STILL}", grid.points.astype("<f4"), "mm")

    def add(self, step: Step) -> None:
        """Append a step; raises InputError where its fields do not fit."""
        names = self._checked(step)
        position = self._joined(step, "position")
        self._grow("Points", position, "mm")
        self._grow("PointData/displacement", position - self._grid.points, "mm")
        for name in names:
            if name not in ("position", _STILL):
                values = self._joined(step, name)
                self._grow(f"PointData/{name}", values[:, _ORDER] if _is_tensor(name) else values, _unit(name))
        for name, numbers in step.numbers.items():
            self._grow(f"FieldData/{name}", np.atleast_2d(numbers).astype("<f8"), _unit(name))
        self.times.append(step.time)

    def _checked(self, step: Step) -> list[str]:
        """Names of the step's fields, the same in all steps and all muscles."""
        found = {muscle: set(step.fields.get(muscle, {})) for muscle in self._grid.muscles}
        first = next(iter(found.values()))
        if not self.times:
            self._names, self._numbers = found, {name: np.size(value) for name, value in step.numbers.items()}
        if "position" not in first or any(names != first for names in found.values()) or found != self._names:
            wanted = ", ".join(sorted(self._names[self._grid.muscles[0]] | {"position"}))
            raise InputError(f"time {step.time:g}: expected the fields {wanted} of {', '.join(found)}, got {found}")
        if {name: np.size(value) for name, value in step.numbers.items()} != self._numbers:
            raise InputError(f"time {step.time:g}: expected the numbers {self._numbers}, got {step.numbers}")
        return sorted(first)

    def _joined(self, step: Step, name: str) -> np.ndarray:
        """A field at the points of all muscles, float32."""
        parts = []
        for muscle, body in self._bodies.items():
            values = np.asarray(step.fields[muscle][name])
            shape = (len(body.reference), *([len(c)] if (c := _components(name)) else values.shape[1:]))
            if values.shape != shape:
                raise InputError(f"{muscle}/{name}: expected the shape {shape}, got {values.shape}")
            parts.append(values)
        return np.concatenate(parts).astype("<f4")

    def _grow(self, name: str, values: np.ndarray, unit: str) -> None:
        """Append rows to a data set, made when it is first used: a chunk for each step."""
        rows, shape = len(values), values.shape[1:]
        if name not in self._root:
            made = self._root.create_dataset(
                name, (0, *shape), values.dtype, maxshape=(None, *shape), chunks=(max(rows, 1), *shape)
            )
            made.attrs["units"] = unit
        data = self._root[name]
        data.resize(len(data) + rows, axis=0)
        data[-rows:] = values

    def end(self) -> None:
        """Where each step begins in every data set."""
        count, nodes = len(self.times), len(self._grid.points)
        if not count:
            raise InputError("expected at least one step, got none")
        steps, zeros, each = self._root.create_group("Steps"), np.zeros(count, int), np.arange(count)
        steps.attrs["NSteps"] = count
        steps["Values"] = np.array(self.times)
        steps["NumberOfParts"] = np.ones(count, int)
        steps["PartOffsets"], steps["PointOffsets"] = zeros, each * nodes
        steps["CellOffsets"] = steps["ConnectivityIdOffsets"] = zeros[:, None]
        steps.create_group("CellDataOffsets")["muscle"] = zeros
        points = steps.create_group("PointDataOffsets")
        for name in self._root["PointData"]:
            points[name] = zeros if name == _STILL else each * nodes
        offsets, sizes = steps.create_group("FieldDataOffsets"), steps.create_group("FieldDataSizes")
        for name, size in self._numbers.items():
            offsets[name], sizes[name] = each, np.tile([size, 1], (count, 1))


def _components(name: str) -> tuple[str, ...]:
    return FIELDS[name].components if name in FIELDS else ()


def _is_tensor(name: str) -> bool:
    return _components(name) == VOIGT


def _unit(name: str) -> str:
    return FIELDS[name].unit if name in FIELDS else ""
