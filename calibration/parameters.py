"""Parameters of a muscle by dotted keys, such as `belly.peak_stress`: read, replaced, written into an arm's file."""

from pathlib import Path

import tomlkit

from myograph.anatomy.model import Arm
from myograph.files import write_whole


def values_of(arm: Arm, name: str, keys: tuple[str, ...]) -> dict[str, float]:
    """The muscle's present values."""
    pairs = (key.split(".") for key in keys)
    return {f"{section}.{entry}": getattr(getattr(arm.muscles[name], section), entry) for section, entry in pairs}


def with_values(arm: Arm, name: str, values: dict[str, float]) -> Arm:
    """The arm with other parameters of one muscle; they are checked as those of a file are."""
    data = arm.model_dump(mode="json")
    for key, value in values.items():
        section, entry = key.split(".")
        data["muscles"][name][section][entry] = float(value)
    return Arm.model_validate(data)


def write_values(path: Path, name: str, values: dict[str, float], record: dict) -> None:
    """Put parameters and residuals of one muscle into the arm's file; its comments stay."""
    document = tomlkit.parse(path.read_text(encoding="utf-8"))
    muscle = document["muscles"][name]
    for key, value in values.items():
        section, entry = key.split(".")
        muscle[section][entry] = value
    muscle["calibration"] = record
    write_whole(path, lambda file: file.write(tomlkit.dumps(document).encode()))
