"""Who made a store, at what cost, and where its tables lay: no part of the store's checksum, nothing depends on it."""

import json
from collections.abc import Mapping
from pathlib import Path

from myograph.ensemble.store.aside import ASIDE, place

PROVENANCE = "provenance.json"


def provenance(store: Path) -> dict[str, str]:
    """Versions, command, seconds; empty where the file is missing or damaged."""
    try:
        return {str(key): str(value) for key, value in json.loads((store / PROVENANCE).read_bytes()).items()}
    except (OSError, ValueError, AttributeError):
        return {}


def provenance_bytes(told: Mapping[str, str]) -> bytes:
    """The file's bytes."""
    return json.dumps(dict(told), indent=1).encode()


def add_provenance(store: Path, told: Mapping[str, str]) -> None:
    """Say more, or something else; raises OSError without room."""
    (store / ASIDE).mkdir(exist_ok=True)
    place(store, store / PROVENANCE, provenance_bytes({**provenance(store), **told}))
