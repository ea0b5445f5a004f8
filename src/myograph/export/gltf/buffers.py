"""Numbers in one binary buffer, little endian, each array with the accessor that says how it is read."""

from typing import Any

import numpy as np

FLOAT, SHORT, INTEGER = 5126, 5123, 5125
VERTICES, INDICES = 34962, 34963
_KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
_FITS_SHORT = 65535


class Buffers:
    """Grows by an array at a time."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def floats(self, values: np.ndarray, *, vertices: bool = False, bounds: bool = False) -> int:
        """Number of a new accessor of floats; `bounds` tells the least and the largest value of each column."""
        rows = np.ascontiguousarray(values if values.ndim == 2 else values[:, None], dtype="<f4")
        accessor = {"componentType": FLOAT, "count": len(rows), "type": _KINDS[rows.shape[1]]}
        if bounds:
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return self._add(rows.tobytes(), accessor, VERTICES if vertices else None)

    def indices(self, triangles: np.ndarray) -> int:
        """Number of a new accessor of corners."""
        short = triangles.max() < _FITS_SHORT
        flat = triangles.ravel().astype("<u2" if short else "<u4")
        accessor = {"componentType": SHORT if short else INTEGER, "count": len(flat), "type": "SCALAR"}
        return self._add(flat.tobytes(), accessor, INDICES)

    def _add(self, data: bytes, accessor: dict[str, Any], target: int | None) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        self.views.append(view if target is None else {**view, "target": target})
        self.accessors.append({"bufferView": len(self.views) - 1, **accessor})
        self.data += data
        return len(self.accessors) - 1
