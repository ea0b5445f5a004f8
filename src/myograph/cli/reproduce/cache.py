"""What was found, kept in a folder by checksum: a trial that was made once is not made again.

One file a trial, written whole: `<key>.npz` holds the arrays and, under `told`, the figures as JSON. `format.json` says
what wrote the folder; one of another format or version is made anew.
"""

import json
import shutil
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

import myograph
from myograph.files import write_whole

FORMAT = 1
"""Of what a trial says; a change of what is measured is a change of the format."""
VERSION = "format.json"
TOLD = "told"


@dataclass(frozen=True)
class Found:
    """What came of a trial.

    Parameters
    ----------
    told
        `protocols` (protocol -> figure -> value), `seconds`, `stored`, and more for some.
    arrays
        `node_mm_<protocol>`, `node_mpa_<protocol>`, `curve`, `nodes_before`, ...: see `trying`.
    """

    told: Mapping[str, Any]
    arrays: Mapping[str, np.ndarray] = field(default_factory=dict)


@dataclass(frozen=True)
class Cache:
    """A folder of files by key."""

    folder: Path

    def prepare(self) -> bool:
        """Make the folder what this version writes; whether another version's was thrown away."""
        mark = self.folder / VERSION
        stale = self.folder.exists() and _read_json(mark) != _version()
        if stale:
            shutil.rmtree(self.folder)
        if not mark.exists():
            write_whole(mark, lambda file: file.write(json.dumps(_version()).encode()))
        for aside in self.folder.glob(".*.npz-*"):
            aside.unlink(missing_ok=True)
        return stale

    def get(self, key: str) -> Found | None:
        """What is kept; None where there is nothing, or where it cannot be read."""
        try:
            with np.load(self._path(key)) as file:
                arrays = {name: file[name] for name in file.files if name != TOLD}
                return Found(json.loads(file[TOLD].tobytes()), arrays)
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
            return None

    def put(self, key: str, found: Found) -> None:
        """Keep it; raises InputError where there is no room."""
        told = np.frombuffer(json.dumps(found.told).encode(), dtype=np.uint8)

        def write(file: BinaryIO) -> None:
            np.savez_compressed(file, allow_pickle=False, told=told, **found.arrays)

        write_whole(self._path(key), write)

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.npz"


def _version() -> dict[str, Any]:
    return {"format": FORMAT, "myograph": myograph.__version__}


def _read_json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
