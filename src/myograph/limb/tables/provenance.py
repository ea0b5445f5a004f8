"""What a table was made from, as a checksum to compare and as words to read."""

import hashlib
import json
from importlib.metadata import PackageNotFoundError, version

from myograph.anatomy.load import arm_checksum, muscle_checksum
from myograph.anatomy.model import Arm
from myograph.limb.tables.spec import BASIS, TableSpec

FORMAT = 3
"""Version of the tables' files."""
_PACKAGES = ("ngsolve", "numpy", "scipy")


def table_key(arm: Arm, name: str, preset: str, spec: TableSpec) -> str:
    """Checksum of everything a table depends on."""
    made_of = [FORMAT, muscle_checksum(arm, name), name, preset, BASIS.name, BASIS.degree, spec.as_dict()]
    return hashlib.sha256(json.dumps(made_of, sort_keys=True).encode()).hexdigest()


def provenance(arm: Arm, seconds: float) -> dict[str, str]:
    """Arm, versions, and the processor time of all states [s]."""
    return {
        "arm": arm.name,
        "arm_checksum": arm_checksum(arm),
        "myograph": version("myograph"),
        **{package: _version(package) for package in _PACKAGES},
        "basis": f"{BASIS.name}, degree {BASIS.degree}",
        "cpu_seconds": f"{seconds:.1f}",
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"
