"""Files appear whole or not at all: written beside their place under a temporary name, then renamed.

An interrupt or a full disk leaves the old file as it was and nothing else.
"""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from myograph.errors import InputError


def write_whole(path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Let `write` fill a new file that then takes the place of `path`; raise InputError where it cannot."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    except OSError as problem:
        raise InputError(f"{path}: cannot be written ({problem.strerror}); choose another folder") from None
    aside = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            write(file)
        aside.chmod(0o666 & ~_umask())
        aside.replace(path)
    except OSError as problem:
        raise InputError(
            f"{path}: cannot be written ({problem.strerror}); free some room or choose another folder"
        ) from None
    finally:
        aside.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
