"""Triangles from STL files, binary or text.

Nothing that the file says of itself is believed: a binary file's count must fit its length, a text's first word may
also stand in a binary file, and a file that is too long is not read at all.
"""

import struct
from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError

LARGEST_FILE = 300_000_000
"""Bytes; about six million triangles, far more than the shape of a muscle needs."""
_HEADER, _RECORD, _LAST_LINE = 84, 50, 300


def read_stl(path: Path) -> Float[np.ndarray, "triangles 3 3"]:
    """Corners of the triangles [the file's unit] in the STL file at `path`, as they stand there."""
    try:
        size = path.stat().st_size
        if size > LARGEST_FILE:
            raise InputError(
                f"{path}: expected at most {LARGEST_FILE} bytes, got {size}; coarsen the surface in a mesh editor"
            )
        data = path.read_bytes()
    except OSError as problem:
        raise InputError(f"{path}: cannot be read: {problem.strerror}; expected an STL file") from None
    is_text = data.lstrip()[:5].lower() == b"solid" and _said(data) != _held(data)
    corners = _from_text(data, path) if is_text else _from_binary(data, path)
    if len(corners) == 0:
        raise InputError(f"{path}: expected an STL file with triangles, found none in it")
    if not np.isfinite(corners).all():
        first = int(np.flatnonzero(~np.isfinite(corners).all(axis=(1, 2)))[0])
        raise InputError(f"{path}: triangle {first} has a corner that is no number; export the surface again")
    return corners


def _from_binary(data: bytes, path: Path) -> Float[np.ndarray, "triangles 3 3"]:
    if len(data) < _HEADER:
        raise InputError(f"{path}: expected an STL file, got {len(data)} bytes, fewer than its header has")
    if _said(data) != _held(data):
        raise InputError(
            f"{path}: not a whole STL file: its header says {_said(data)} triangles, the rest holds"
            f" {_held(data):g}; fetch or export it again"
        )
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, offset=_HEADER)["corners"].astype(float)


def _said(data: bytes) -> int:
    """Number of triangles that a binary file says it has."""
    return struct.unpack("<I", data[80:84].ljust(4, b"\0"))[0]


def _held(data: bytes) -> float:
    """Number of triangles that a binary file has room for."""
    return (len(data) - _HEADER) / _RECORD


def _from_text(data: bytes, path: Path) -> Float[np.ndarray, "triangles 3 3"]:
    words = data.split()
    places = [k for k, word in enumerate(words) if word.lower() == b"vertex"]
    facets = sum(word.lower() == b"endfacet" for word in words)
    if len(places) != 3 * facets or b"endsolid" not in data[-_LAST_LINE:].lower():
        raise InputError(
            f"{path}: not a whole STL file: expected 3 vertices in each of its {facets} closed facets and 'endsolid' at"
            f" its end, got {len(places)} vertices; fetch or export it again"
        )
    try:
        numbers = [[float(word) for word in words[k + 1 : k + 4]] for k in places]
        return np.array(numbers, dtype=float).reshape(-1, 3, 3)
    except ValueError:
        bad = next(k for k in places if not _are_numbers(words[k + 1 : k + 4]))
        found = b" ".join(words[bad + 1 : bad + 4]).decode("utf-8", "replace")
        raise InputError(f"{path}: expected three numbers after 'vertex', got '{found}'") from None


def _are_numbers(words: list[bytes]) -> bool:
    try:
        return len([float(word) for word in words]) == 3
    except ValueError:
        return False
