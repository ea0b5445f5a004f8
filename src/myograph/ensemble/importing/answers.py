"""From a file's arrays to the fields of a muscle: names, units, order of components; nothing is guessed."""

import hashlib
from collections.abc import Iterable

import numpy as np
from jaxtyping import Float

from myograph.ensemble.importing.frames import Frame
from myograph.ensemble.importing.mapping import POINTS, Mapping, TensorMapping
from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.fields import FIELDS, VOIGT, von_mises
from myograph.mesh.vtk import skin_of

_FULL = {"xx": 0, "yy": 4, "zz": 8, "yz": 5, "xz": 2, "xy": 1}
"""Places of the components in a full matrix, row by row."""


def body_of(frame: Frame, mapping: Mapping) -> Body:
    """The reference body of a file; raises InputError where its points or elements do not fit."""
    points = _points(frame) * mapping.units.length_mm
    none = np.zeros((0, 4), int)
    if frame.cells is None:
        return Body(points, none, none)
    if not 0 <= frame.cells.min(initial=0) <= frame.cells.max(initial=-1) < len(points):
        raise InputError(f"{frame.source}: cells: expected nodes from 0 to {len(points) - 1}, got others")
    return Body(points, skin_of(points, frame.cells), frame.cells.astype(int))


def fields_of(frame: Frame, mapping: Mapping, reference: Float[np.ndarray, "nodes 3"]) -> dict[str, np.ndarray]:
    """The fields of a case, mm and MPa; raises InputError for arrays that are missing, or of another shape."""
    asked, units = mapping.fields, mapping.units
    moved = _array(frame, asked.position.array, len(reference), (3,)) * units.length_mm
    found = {"position": reference + moved if asked.position.displacement else moved}
    if asked.cauchy_stress is not None:
        found["cauchy_stress"] = _tensor(frame, asked.cauchy_stress, len(reference)) * units.stress_mpa
        found["von_mises"] = von_mises(found["cauchy_stress"])
    for name in ("von_mises", "fibre_stretch", "pressure"):
        given = getattr(asked, name)
        if given is not None:
            factor = units.stress_mpa if FIELDS[name].unit == "MPa" else 1.0
            found[name] = _array(frame, given.array, len(reference), ()) * factor
    return {name: _finite(frame, name, found[name]) for name in asked.stored}


def bodies_checksum(bodies: Iterable[Body]) -> str:
    """SHA-256 of reference bodies: what stands for the arm where there is none."""
    digest = hashlib.sha256()
    for body in bodies:
        digest.update(np.ascontiguousarray(body.reference, "<f8").tobytes())
        digest.update(np.ascontiguousarray(body.cells, "<i8").tobytes())
    return digest.hexdigest()


def _points(frame: Frame) -> Float[np.ndarray, "nodes 3"]:
    points = frame.points
    if points is None or points.ndim != 2 or points.shape[1] != 3 or len(points) < 2:
        found = "none" if points is None else points.shape
        raise InputError(f"{frame.source}: points: expected places of three coordinates, got {found}")
    return _finite(frame, POINTS, np.asarray(points, float))


def _array(frame: Frame, name: str, nodes: int, shape: tuple[int, ...]) -> np.ndarray:
    if name == POINTS:
        values = _points(frame)
    elif name in frame.arrays:
        values = np.asarray(frame.arrays[name])
    else:
        known = ", ".join(sorted(frame.arrays)) or "none"
        raise InputError(f"{frame.source}: expected an array '{name}' at the points, got {known}")
    if shape == () and values.shape == (nodes, 1):
        values = values[:, 0]
    if values.shape != (nodes, *shape) or not np.issubdtype(values.dtype, np.number):
        raise InputError(f"{frame.source}: {name}: expected numbers of the shape {(nodes, *shape)}, got {values.shape}")
    return values.astype(float)


def _tensor(frame: Frame, asked: TensorMapping, nodes: int) -> Float[np.ndarray, "nodes 6"]:
    values = frame.arrays.get(asked.array)
    size = 0 if values is None else int(np.prod(values.shape[1:]))
    if values is not None and size == 9:
        return _array(_with(frame, asked.array, values.reshape(len(values), 9)), asked.array, nodes, (9,))[
            :, [_FULL[name] for name in VOIGT]
        ]
    return _array(frame, asked.array, nodes, (6,))[:, [asked.order.index(name) for name in VOIGT]]


def _with(frame: Frame, name: str, values: np.ndarray) -> Frame:
    return Frame(frame.source, frame.points, {**frame.arrays, name: values}, frame.cells)


def _finite(frame: Frame, name: str, values: np.ndarray) -> np.ndarray:
    if not np.isfinite(values).all():
        bad = int(values.size - np.isfinite(values).sum())
        raise InputError(f"{frame.source}: {name}: expected finite numbers, got {bad} that are not")
    return values
