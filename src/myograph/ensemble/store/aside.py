"""Files of a store appear whole: written in its folder `.aside`, then renamed to their place.

What a killed writer leaves lies in `.aside` only and is swept when the store is next worked on.
"""

import os
import shutil
import uuid
from contextlib import suppress
from pathlib import Path

ASIDE = ".aside"


def place(store: Path, path: Path, data: bytes) -> None:
    """Put a file to its place in a store; raises OSError where there is no room."""
    aside = store / ASIDE / uuid.uuid4().hex
    try:
        with open(aside, "wb") as file:
            file.write(data)
        os.replace(aside, path)
    except OSError:
        with suppress(OSError):
            aside.unlink()
        raise


def sweep(store: Path) -> None:
    """Remove what killed writers left; only for the one who holds the store's lock."""
    shutil.rmtree(store / ASIDE, ignore_errors=True)
    (store / ASIDE).mkdir(exist_ok=True)
