"""Plain arrays out of the bytes of an .npz file: never pickled, never larger unpacked than expected."""

import io
import zipfile
import zlib

import numpy as np

from myograph.errors import InputError


def read_arrays(data: bytes, source: str, most_bytes: int) -> dict[str, np.ndarray]:
    """All arrays by name; raises InputError for bytes that are no such file, and for one that unpacks to too much."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            unpacked = sum(member.file_size for member in packed.infolist())
        if unpacked > most_bytes:
            raise InputError(f"{source}: expected at most {most_bytes} bytes of arrays, got {unpacked}")
        with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
            return dict(arrays)
    except (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as problem:
        raise InputError(f"{source}: not a file of plain arrays: {problem}") from None
