"""One case in one array of a store: its shape, its place and its bytes.

Fields are float32, relative rounding 6e-8: 2e-5 mm in a position, where tables promise 1e-1 and their compression 1e-3;
solves are no better. Angles, moments and loads are float64. One chunk is one case, compressed by Blosc (zstd, bytes
shuffled) with one thread: the same values make the same bytes. Chunks are encoded here, not by the Zarr library, which
takes ten times as long for one; it reads them, and would write the same.
"""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numcodecs import blosc  # pyright: ignore[reportAttributeAccessIssue]

from myograph.ensemble.store.checksum import checksum
from myograph.errors import InputError
from myograph.fields import AXES, FIELDS, VOIGT

_DIMENSIONS = {AXES: ("axes",), VOIGT: ("voigt",), (): ()}


def dimensions(field: str) -> tuple[str, ...]:
    """Names of the dimensions of a field of many cases."""
    return ("cases", "nodes", *_DIMENSIONS[FIELDS[field].components])


def case_shape(field: str, nodes: int) -> tuple[int, ...]:
    """Shape of a field of one case."""
    components = FIELDS[field].components
    return (nodes, len(components)) if components else (nodes,)


def chunk_path(store: Path, muscle: str, field: str, case: int) -> Path:
    """The file of one case in one array."""
    zeros = ".0" * (len(dimensions(field)) - 1)
    return store / muscle / field / f"c.{case}{zeros}"


def remove_chunks(store: Path, arrays: Iterable[tuple[str, str]], case: int) -> None:
    """Remove what a case has in arrays, named by muscle and field."""
    for muscle, field in arrays:
        chunk_path(store, muscle, field, case).unlink(missing_ok=True)


def encode(field: str, values: np.ndarray, nodes: int) -> bytes:
    """The chunk of one case; raises InputError unless there are as many finite numbers as the field needs."""
    expected = case_shape(field, nodes)
    if np.shape(values) != expected:
        raise InputError(f"{field}: expected the shape {expected}, got {np.shape(values)}")
    with np.errstate(over="ignore"):
        rounded = np.ascontiguousarray(values, dtype="<f4")
    finite = np.isfinite(rounded)
    if not finite.all():
        raise InputError(f"{field}: expected finite numbers, got {int(finite.size - finite.sum())} that are not")
    blosc.use_threads = False
    return bytes(blosc.Blosc(cname="zstd", clevel=3, shuffle=blosc.SHUFFLE, blocksize=0).encode(rounded))


def read_chunk(store: Path, name: str, case: int, written: str, nodes: int) -> Float[np.ndarray, "nodes ..."]:
    """The array MUSCLE/FIELD of a case; raises InputError unless its bytes have the checksum they were written with."""
    muscle, field = name.split("/")
    repair = f"run 'myograph ensemble check {store} --repair'"
    try:
        data = chunk_path(store, muscle, field, case).read_bytes()
    except OSError as problem:
        raise InputError(f"{store}: case {case}, {name}: {problem.strerror}; {repair}") from None
    if checksum(data) != written:
        raise InputError(f"{store}: case {case}, {name}: not the bytes that were written; {repair}")
    return decode(field, data, nodes)


def decode(field: str, data: bytes, nodes: int) -> Float[np.ndarray, "nodes ..."]:
    """The values of a chunk; raises InputError for bytes that are no chunk of this field, or hold no numbers."""
    try:
        values = np.frombuffer(blosc.decompress(data), dtype="<f4").reshape(case_shape(field, nodes))
    except (RuntimeError, ValueError) as problem:
        raise InputError(f"{field}: not a readable chunk ({problem})") from None
    if not np.isfinite(values).all():
        raise InputError(f"{field}: expected finite numbers, got some that are not")
    return values
