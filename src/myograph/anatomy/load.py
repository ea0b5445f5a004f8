"""Arms from TOML: the built-in one, or the user's own."""

import hashlib
import json
from importlib.resources import as_file, files
from pathlib import Path

from myograph.anatomy.model import Arm
from myograph.config import read_toml


def built_in_arm() -> Arm:
    """The left arm that comes with the package."""
    with as_file(files("myograph.anatomy") / "left_arm.toml") as path:
        return load_arm(path)


def load_arm(path: Path) -> Arm:
    """Arm from a TOML file; raise InputError naming file and key where it does not fit."""
    return read_toml(path, Arm)


def muscle_checksum(arm: Arm, name: str) -> str:
    """SHA-256 of all that the finite elements of one muscle see: itself, the bones, the hinge; not what it lifts."""
    seen = arm.model_dump(mode="json", include={"hinge": True, "bones": True, "muscles": {name: True}})
    seen["muscles"][name].pop("calibration", None)
    return hashlib.sha256(json.dumps(seen, sort_keys=True).encode()).hexdigest()


def arm_checksum(arm: Arm) -> str:
    """SHA-256 of everything the arm says, whatever the layout of its file."""
    text = json.dumps(arm.model_dump(mode="json"), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()
