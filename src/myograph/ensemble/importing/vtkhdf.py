"""Reading a VTKHDF file of one unstructured grid in one part: points, arrays and elements of one of its steps."""

from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError, MissingPackageError

Contents = tuple[Float[np.ndarray, "nodes 3"], dict[str, np.ndarray], Int[np.ndarray, "cells element_nodes"] | None]


def read_vtkhdf(path: Path, step: int | None) -> Contents:
    """One step; None is the first one. Raises InputError for another file and for a step that is not there."""
    try:
        import h5py
    except ModuleNotFoundError:
        raise MissingPackageError("h5py", "export", "reading VTKHDF") from None
    try:
        with h5py.File(path, "r") as file:
            return _read(path, file["VTKHDF"], step or 0)
    except (OSError, KeyError, ValueError, TypeError, IndexError, AttributeError) as problem:
        raise InputError(f"{path}: not a readable VTKHDF file of one unstructured grid: {problem}") from None


def _read(path: Path, root: Any, step: int) -> Contents:
    kind = root.attrs["Type"]
    if (kind.decode() if isinstance(kind, bytes) else str(kind)) != "UnstructuredGrid":
        raise InputError(f"{path}: expected one unstructured grid, got {kind}")
    steps = root.get("Steps")
    count = 1 if steps is None else int(steps.attrs["NSteps"])
    if step >= count:
        raise InputError(f"{path}: expected a step for case {step}, got {count} steps")
    if steps is not None and "NumberOfParts" in steps and int(steps["NumberOfParts"][step]) != 1:
        raise InputError(f"{path}: expected a grid in one part, got {int(steps['NumberOfParts'][step])}")
    part = 0 if steps is None or "PartOffsets" not in steps else int(steps["PartOffsets"][step])
    nodes = int(root["NumberOfPoints"][part])
    first = 0 if steps is None else int(steps["PointOffsets"][step])
    points = np.asarray(root["Points"][first : first + nodes], float)
    arrays = {}
    for name, data in root.get("PointData", {}).items():
        begin = first if steps is None else int(steps["PointDataOffsets"][name][step])
        arrays[name] = np.asarray(data[begin : begin + nodes])
    return points, arrays, _cells(path, root, steps, (step, part))


def _cells(path: Path, root: Any, steps: Any, place: tuple[int, int]) -> np.ndarray | None:
    step, part = place
    cells, corners = int(root["NumberOfCells"][part]), int(root["NumberOfConnectivityIds"][part])
    first = 0 if steps is None else int(np.ravel(steps["ConnectivityIdOffsets"][step])[0])
    begin = 0 if steps is None else int(np.ravel(steps["CellOffsets"][step])[0])
    types = np.asarray(root["Types"][begin : begin + cells])
    if not cells or set(types.tolist()) <= {1, 3, 5, 9}:
        return None
    width = corners // cells
    if len(set(types.tolist())) != 1 or width * cells != corners:
        raise InputError(f"{path}: expected elements of one kind, got VTK's types {sorted(set(types.tolist()))}")
    return np.asarray(root["Connectivity"][first : first + corners]).reshape(cells, width)
