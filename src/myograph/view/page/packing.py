"""Numbers of a page: one blob of little-endian arrays in base64, and for each array where it lies in the blob.

Real numbers are single precision, or double where they are few and matter; with `compact`, each row of an array is a
scale times whole numbers of 16 bits, which is off by 1.5e-5 of the row's largest value at most.
"""

import base64
from typing import Any

import numpy as np
from jaxtyping import Float, Int

ALIGNED = 8
LARGEST = 2**15 - 1


class Packer:
    """Collects arrays; each `add` gives back what the page is told of the array."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0

    @property
    def size(self) -> int:
        """Bytes so far."""
        return self._size

    def reals(self, values: Float[np.ndarray, "..."]) -> dict[str, Any]:
        """Numbers in single precision."""
        return self._add("f4", values.astype("<f4"))

    def doubles(self, values: Float[np.ndarray, "..."]) -> dict[str, Any]:
        """Numbers in double precision."""
        return self._add("f8", values.astype("<f8"))

    def compact(self, values: Float[np.ndarray, "rows ..."]) -> dict[str, Any]:
        """Numbers as 16 bits and a scale for each row."""
        largest = np.abs(values.reshape(len(values), -1)).max(axis=1)
        scale = np.where(largest > 0, largest, 1.0) / LARGEST
        whole = np.rint(values / scale.reshape(-1, *[1] * (values.ndim - 1)))
        return {**self._add("i2", whole.astype("<i2")), "scale": scale.tolist()}

    def integers(self, values: Int[np.ndarray, "..."]) -> dict[str, Any]:
        """Whole numbers from 0 on."""
        kind = "u2" if values.max(initial=0) < 2**16 else "u4"
        return self._add(kind, values.astype(f"<{kind}"))

    def text(self) -> str:
        """The blob in base64."""
        return base64.b64encode(b"".join(self._parts)).decode("ascii")

    def _add(self, kind: str, values: np.ndarray) -> dict[str, Any]:
        data = np.ascontiguousarray(values).tobytes()
        told = {"type": kind, "shape": list(values.shape), "at": self._size}
        padded = data + bytes(-len(data) % ALIGNED)
        self._parts.append(padded)
        self._size += len(padded)
        return told
