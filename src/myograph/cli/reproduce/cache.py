"""What was found, kept in a folder by checksum: a trial that was made once is not made again.

One file a trial, written whole: `<key>.npz` holds the arrays and, under `told`, the figures as JSON. `format.json` says
what wrote the folder; one of another format or version is made anew.
"""

import json
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

import myograph
from myograph.files import refusing, sweep, write_whole

FORMAT = 2
"""Of what a trial says; a change of what is measured is a change of the format."""
VERSION = "format.json"
TOLD = "told"


@dataclass(frozen=True)
class Found:
    """What came of a trial.

    Parameters
    ----------
    told
        `protocols` (protocol -> figure -> value), `stored`, and more for some: see `trying`.
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
        """Make the folder what this version writes; whether another version's was thrown away.

        What was left half-written goes; trainings under `running` stay, they are gone on with.
        """
        mark = self.folder / VERSION
        stale = self.folder.exists() and _read_json(mark) != _version()
        if stale:
            with refusing(self.folder):
                shutil.rmtree(self.folder)
        if not mark.exists():
            write_whole(mark, lambda file: file.write(json.dumps(_version()).encode()))
        sweep(self.folder, VERSION, "*.npz")
        return stale

    def get(self, key: str) -> Found | None:
        """What is kept; None where there is nothing, or where it cannot be read.

        What a damaged archive raises depends on the byte: nearly anything of zipfile, zlib and NumPy.
        """
        path = self._path(key)
        try:
            with np.load(path) as file:
                arrays = {name: file[name] for name in file.files}
                if len(arrays) != _members(path):
                    return None
                return Found(json.loads(arrays.pop(TOLD).tobytes()), arrays)
        except Exception:
            return None

    def put(self, key: str, found: Found) -> None:
        """Keep it; raises InputError where there is no room."""
        told = np.frombuffer(json.dumps(found.told).encode(), dtype=np.uint8)

        def write(file: BinaryIO) -> None:
            np.savez_compressed(file, allow_pickle=False, told=told, **found.arrays)

        write_whole(self._path(key), write)

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.npz"


def _members(path: Path) -> int:
    """How many arrays the last record of an archive counts.

    Reading an array checks its sum; one whose entry in the directory is damaged may be passed over in silence.
    """
    return int.from_bytes(path.read_bytes()[-12:-10], "little")


def _version() -> dict[str, Any]:
    return {"format": FORMAT, "myograph": myograph.__version__}


def _read_json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
