"""What another program's file says of one case: points, arrays at the points, elements.

Read are VTU and legacy VTK files (by meshio), VTKHDF files of one grid, with or without steps (by h5py), and NumPy's
.npz without pickled objects. In an .npz file `points` and `cells` have these names; nodes of elements are in VTK's
order everywhere, and a leading dimension counts the cases where one file holds all of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.importing.mapping import POINTS
from myograph.ensemble.importing.vtkhdf import read_vtkhdf
from myograph.errors import InputError, MissingPackageError
from myograph.mesh.vtk import KINDS, from_vtk

_OURS = {kind.name: nodes for nodes, kind in KINDS.items()}


@dataclass(frozen=True)
class Frame:
    """One case of one file.

    Parameters
    ----------
    source
        The file, for messages.
    points
        None where the file has none.
    arrays
        At the points.
    cells
        In our order; None where there are none.
    """

    source: Path
    points: Float[np.ndarray, "nodes 3"] | None
    arrays: Mapping[str, np.ndarray]
    cells: Int[np.ndarray, "cells element_nodes"] | None


class Frames:
    """The cases of files; a file that holds all cases is opened once."""

    def __init__(self) -> None:
        self._kept: tuple[Path, dict[str, np.ndarray]] | None = None

    def read(self, path: Path, case: int | None = None) -> Frame:
        """A file, or one case of a file that holds all; raises InputError for what cannot be read."""
        if not path.is_file():
            raise InputError(f"{path}: expected a file, found none there")
        suffix = path.suffix.lower()
        if suffix == ".npz":
            return self._numpy(path, case)
        if suffix in (".vtkhdf", ".hdf"):
            points, arrays, cells = read_vtkhdf(path, case)
            return Frame(path, points, arrays, None if cells is None else _ours(path, cells))
        if case is not None:
            raise InputError(f"{path}: expected .npz or .vtkhdf for a file of all cases; else put {{case}} in 'files'")
        if suffix in (".vtu", ".vtk"):
            return _meshio(path, suffix)
        raise InputError(f"{path}: expected a file .vtu, .vtk, .vtkhdf or .npz, got '{suffix}'")

    def _numpy(self, path: Path, case: int | None) -> Frame:
        if self._kept is None or self._kept[0] != path:
            self._kept = (path, _load(path))
        arrays = dict(self._kept[1])
        cells = arrays.pop("cells", None)
        if case is not None:
            if any(values.ndim == 0 or len(values) <= case for name, values in arrays.items() if name != POINTS):
                raise InputError(f"{path}: expected a value for case {case} in every array, got fewer")
            arrays = {n: v if n == POINTS and v.ndim == 2 else v[case] for n, v in arrays.items()}
        points = arrays.pop(POINTS, None)
        return Frame(path, points, arrays, None if cells is None else _ours(path, cells))


def _load(path: Path) -> dict[str, np.ndarray]:
    try:
        with np.load(path, allow_pickle=False) as file:
            return {name: np.asarray(file[name]) for name in file.files}
    except (OSError, ValueError, BadZipFile, KeyError, EOFError) as problem:
        raise InputError(f"{path}: not a readable .npz file without pickled objects: {problem}") from None


def _meshio(path: Path, suffix: str) -> Frame:
    try:
        import meshio
    except ModuleNotFoundError:
        raise MissingPackageError("meshio", "export", "reading VTK files") from None
    reader: Any = meshio.vtu if suffix == ".vtu" else meshio.vtk
    try:
        mesh = reader.read(str(path))
    except Exception as problem:
        raise InputError(f"{path}: not a readable {suffix} file: {type(problem).__name__}: {problem}") from None
    solids = [block for block in mesh.cells if block.type in _OURS]
    others = [block.type for block in mesh.cells if block.dim == 3 and block.type not in _OURS]
    if others or len({block.type for block in solids}) > 1:
        found = others + [block.type for block in solids]
        raise InputError(f"{path}: expected solid elements of one kind ({', '.join(_OURS)}), got {', '.join(found)}")
    cells = _ours(path, np.concatenate([block.data for block in solids])) if solids else None
    points = np.asarray(mesh.points, float)
    return Frame(path, points, {name: np.asarray(values) for name, values in mesh.point_data.items()}, cells)


def _ours(path: Path, cells: np.ndarray) -> np.ndarray:
    if cells.ndim != 2 or cells.shape[1] not in KINDS or not np.issubdtype(cells.dtype, np.integer):
        raise InputError(f"{path}: cells: expected whole numbers, 4, 8, 10, 20 or 27 nodes each, got {cells.shape}")
    return from_vtk(cells)
