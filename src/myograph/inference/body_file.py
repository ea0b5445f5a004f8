"""The body that a model knows, `body.npz`: plain arrays, never pickled.

reference        nodes 3                material coordinates X [mm]
skin, cells      facets 4, cells n      nodes of the surface's quadrilaterals and of the elements
low, high        nodes 3                least and largest coordinates of each node in training [mm]
rest_FIELD       nodes ...              the state of the training case with the least activation

`low` and `high` are rounded outward to 2^-6 mm and `rest_FIELD` to the nearest 2^-10 mm or 2^-20 MPa: digits that
nothing depends on would be a quarter of the file.
"""

import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.fields import FIELDS, value_shape
from myograph.inference.arrays import check_array, read_arrays

MOST_UNPACKED = 2**28
_REST = "rest_"
_BOX = 2.0**-6
_FINEST = {"mm": 2.0**-10}
_FINE = 2.0**-20
"""What boxes are rounded to, and values at rest, by unit and of other units."""


@dataclass(frozen=True)
class ModelBody:
    """The body and where it was in training; see the module's table."""

    body: Body
    low: Float[np.ndarray, "nodes 3"]
    high: Float[np.ndarray, "nodes 3"]
    rest: Mapping[str, Float[np.ndarray, "nodes ..."]]

    @property
    def nodes(self) -> int:
        """Number of nodes."""
        return len(self.body.reference)


def body_bytes(body: ModelBody) -> bytes:
    """The bytes of body.npz."""
    arrays = {
        "reference": body.body.reference.astype(np.float32),
        "skin": body.body.skin.astype(np.int32),
        "cells": body.body.cells.astype(np.int32),
        "low": (np.floor(body.low / _BOX) * _BOX).astype(np.float32),
        "high": (np.ceil(body.high / _BOX) * _BOX).astype(np.float32),
        **{_REST + name: _rounded(values, name) for name, values in body.rest.items()},
    }
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, **arrays)
    return file.getvalue()


def _rounded(values: np.ndarray, name: str) -> np.ndarray:
    finest = _FINEST.get(FIELDS[name].unit, _FINE)
    return (np.round(values / finest) * finest).astype(np.float32)


def body_of(data: bytes, source: str) -> ModelBody:
    """The body; raises InputError for bytes that are no such arrays, or arrays that do not fit each other."""
    found = read_arrays(data, source, MOST_UNPACKED)
    _check(found, source)
    rest = {name.removeprefix(_REST): values for name, values in found.items() if name.startswith(_REST)}
    return ModelBody(Body(found["reference"], found["skin"], found["cells"]), found["low"], found["high"], rest)


def _check(arrays: dict[str, np.ndarray], source: str) -> None:
    nodes = len(arrays["reference"]) if arrays.get("reference") is not None and arrays["reference"].ndim else 0
    shapes: dict[str, tuple[int | None, ...]] = {
        **dict.fromkeys(("reference", "low", "high", _REST + "position"), (nodes, 3)),
        "skin": (None, 4),
        "cells": (None, None),
    }
    for name in arrays:
        if name not in shapes:
            shapes[name] = (nodes, *_components(name, source))
    for name, shape in shapes.items():
        kind = "i" if name in ("skin", "cells") else "f"
        check_array(arrays.get(name), shape, kind, f"{source}: {name}")
    if not nodes:
        raise InputError(f"{source}: expected a body of nodes, got none")
    for name in ("skin", "cells"):
        check_nodes(arrays[name], nodes, f"{source}: {name}")


def check_nodes(array: Int[np.ndarray, "..."], nodes: int, source: str) -> None:
    """Raise InputError for a number that no node of a body of so many has."""
    if array.size and not 0 <= array.min() <= array.max() < nodes:
        raise InputError(f"{source}: expected nodes from 0 to {nodes - 1}, got others")


def _components(name: str, source: str) -> tuple[int, ...]:
    field = name.removeprefix(_REST)
    if not name.startswith(_REST) or field not in FIELDS:
        raise InputError(f"{source}: unknown array '{name}'")
    return value_shape(field)
