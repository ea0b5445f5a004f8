"""The file that an export writes: refused where something else lies, whole or not there at all."""

from collections.abc import Callable
from pathlib import Path

from myograph.errors import InputError
from myograph.files import write_whole_folder


def write_place(out: Path, beginning: bytes, write: Callable[[Path], object]) -> None:
    """Let `write` make a new file that takes the place of `out`.

    Parameters
    ----------
    beginning
        The first bytes of such a file. One that begins otherwise, or a folder, is not replaced but raises InputError.
    """
    check_place(out, beginning)
    write_whole_folder(out, write)


def check_place(out: Path, beginning: bytes) -> None:
    """Raise InputError where a folder lies, or a file that begins otherwise."""
    if out.exists() and not _begins(out, beginning):
        raise InputError(f"{out}: expected a new file or one of the same kind, found something else; take another name")


def _begins(path: Path, beginning: bytes) -> bool:
    try:
        with path.open("rb") as file:
            return file.read(len(beginning)) == beginning
    except OSError:
        return False
