"""What a design is asked to be: one table of a TOML file."""

import math
from pathlib import Path
from typing import Literal

from pydantic import Field

from myograph.config import Model
from myograph.errors import InputError

Method = Literal["factorial", "tenths", "sobol", "latin_hypercube", "sparse_grid", "list"]
Range = tuple[float, float]

_OPTIONS: dict[Method, tuple[str, ...]] = {
    "factorial": ("step",),
    "tenths": ("count", "seed"),
    "sobol": ("count", "seed"),
    "latin_hypercube": ("count", "seed"),
    "sparse_grid": ("level",),
    "list": ("file",),
}
_NEEDED = ("count", "level", "file")
_OF_A_LIST = ("hand_load_n", "elbow_angle_deg")


class DesignSpec(Model):
    """How the cases of one part of an ensemble are chosen.

    `step`, `count`, `seed`, `level` and `file` belong to methods (see docs/ensembles.md). A load [N] or an angle
    [degrees] is one number for all cases or, as [low, high], a further dimension; without an angle the arm finds its
    equilibrium. `label` is the word that the cases carry in the variable `design`.
    """

    method: Method = "factorial"
    step: float = 1.0
    count: int | None = Field(default=None, ge=1)
    seed: int = Field(default=0, ge=0)
    level: int | None = Field(default=None, ge=1)
    file: Path | None = None
    hand_load_n: float | Range = 0.0
    elbow_angle_deg: float | Range | None = None
    label: str | None = Field(default=None, min_length=1, max_length=16)

    @property
    def word(self) -> str:
        """The label; without one 'factorial' for a full factorial and 'off_grid' for everything else."""
        return self.label or ("factorial" if self.method == "factorial" else "off_grid")

    @property
    def ranges(self) -> tuple[tuple[str, Range], ...]:
        """The further dimensions."""
        return tuple((name, value) for name in _OF_A_LIST if isinstance(value := getattr(self, name), tuple))

    def check(self) -> None:
        """Raise InputError for an option that the method needs and lacks, or has and does not know."""
        known = _OPTIONS[self.method]
        for name in known:
            if name in _NEEDED and getattr(self, name) is None:
                raise InputError(f"design '{self.method}': expected '{name}', got none")
        foreign = self.model_fields_set - set(known) - {"method", "label"}
        foreign -= set() if self.method == "list" else set(_OF_A_LIST)
        foreign = {name for name in foreign if getattr(self, name) is not None}
        if foreign:
            raise InputError(f"design '{self.method}': unknown option '{min(foreign)}': it knows {', '.join(known)}")
        for name in _OF_A_LIST:
            value = getattr(self, name)
            ends = value if isinstance(value, tuple) else (value,)
            if not all(end is None or math.isfinite(end) for end in ends):
                raise InputError(f"{name}: expected finite numbers, got {value}")
            if isinstance(value, tuple) and not value[0] < value[1]:
                raise InputError(f"{name}: expected a range [low, high] with low below high, got {list(value)}")
