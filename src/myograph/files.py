"""Files and folders appear whole or not at all: written beside their place under a temporary name, then renamed.

An interrupt or a full disk leaves the old file as it was and nothing else. A kill leaves the temporary name, and of a
folder that was just being replaced the old one under it: `sweep` takes both away.
"""

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from myograph.errors import InputError


def write_whole(path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Let `write` fill a new file that then takes the place of `path`; raise InputError where it cannot."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    except OSError as problem:
        raise _refusal(path, problem) from None
    aside = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            write(file)
        aside.chmod(0o666 & ~_umask())
        aside.replace(path)
    except OSError as problem:
        raise _refusal(path, problem) from None
    finally:
        aside.unlink(missing_ok=True)


def write_whole_folder(path: Path, write: Callable[[Path], object]) -> None:
    """Let `write` make a new folder that then takes the place of `path`; raise InputError where it cannot."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        aside = Path(tempfile.mkdtemp(prefix=f".{path.name}-", dir=path.parent))
    except OSError as problem:
        raise _refusal(path, problem) from None
    try:
        write(aside / "new")
        _swap(path, aside)
    except OSError as problem:
        raise _refusal(path, problem) from None
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def sweep(folder: Path, *names: str) -> None:
    """Remove what killed writers of these names left in a folder; a name may be a pattern, as '*.npz'.

    Only for the one who writes them; raises InputError for what cannot be removed.
    """
    for name in names:
        for aside in folder.glob(f".{name}-*"):
            with refusing(aside):
                if aside.is_dir():
                    shutil.rmtree(aside)
                else:
                    aside.unlink(missing_ok=True)


def read_bounded(path: Path, most_bytes: int) -> bytes:
    """The bytes of a plain file; raises InputError for what is none, cannot be read, or is larger."""
    try:
        if not path.is_file():
            raise InputError(f"{path}: cannot be read: expected a plain file there")
        with path.open("rb") as file:
            data = file.read(min(path.stat().st_size, most_bytes) + 1)
    except OSError as problem:
        raise InputError(f"{path}: cannot be read: {problem.strerror}") from None
    if len(data) > most_bytes:
        raise InputError(f"{path}: expected at most {most_bytes} bytes, got more")
    return data


@contextmanager
def refusing(path: Path) -> Iterator[None]:
    """What cannot be written at `path` within becomes an InputError: for what is not written whole (a log, a store)."""
    try:
        yield
    except OSError as problem:
        raise _refusal(path, problem) from None


def _swap(path: Path, aside: Path) -> None:
    """Put the new folder in place; where that fails, put the old one back."""
    if path.exists():
        path.rename(aside / "old")
    try:
        (aside / "new").rename(path)
    except BaseException:
        if (aside / "old").exists():
            (aside / "old").rename(path)
        raise


def _refusal(path: Path, problem: OSError) -> InputError:
    return InputError(
        f"{path}: cannot be written ({problem.strerror or problem}); "
        "free some room and run it again, or choose another folder"
    )


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
