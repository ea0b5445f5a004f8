"""Plain arrays out of the bytes of an .npz file: never pickled, never larger unpacked than expected."""

import io
import math
import zipfile

import numpy as np

from myograph.errors import InputError


def read_arrays(data: bytes, source: str, most_bytes: int) -> dict[str, np.ndarray]:
    """All arrays by name; raises InputError for bytes that are no such file, and for one that unpacks to too much."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            unpacked = sum(member.file_size for member in packed.infolist())
            if unpacked > most_bytes:
                raise InputError(f"{source}: expected at most {most_bytes} bytes of arrays, got {unpacked}")
            return {name.removesuffix(".npy"): _array(packed.read(name)) for name in packed.namelist()}
    except InputError:
        raise
    except Exception as problem:
        raise InputError(f"{source}: not a file of plain arrays: {problem}") from None


def _array(data: bytes) -> np.ndarray:
    """Of the bytes of an .npy file, whose header must not promise more than there is."""
    file = io.BytesIO(data)
    version = np.lib.format.read_magic(file)
    read_header = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}[version]
    shape, _, kind = read_header(file)
    if math.prod(shape) * kind.itemsize != len(data) - file.tell():
        raise ValueError(f"an array of shape {shape} and kind {kind} in {len(data) - file.tell()} bytes")
    file.seek(0)
    return np.lib.format.read_array(file, allow_pickle=False)


def check_array(
    array: np.ndarray | None, shape: tuple[int | None, ...], kind: str, source: str, unknown: bool = False
) -> None:
    """Raise InputError unless it is there, of that shape (None: any) and NumPy's letter of a kind, and finite.

    With `unknown` there may be NaN in it.
    """
    if array is None:
        raise InputError(f"{source}: expected an array, found none")
    fits = array.ndim == len(shape) and all(want in (None, got) for want, got in zip(shape, array.shape, strict=True))
    if not fits or array.dtype.kind != kind:
        raise InputError(f"{source}: expected shape {shape} of kind '{kind}', got {array.shape} of {array.dtype}")
    if kind == "f" and not (np.isfinite(array) | (unknown & np.isnan(array))).all():
        raise InputError(f"{source}: expected finite numbers, got NaN or infinity")
