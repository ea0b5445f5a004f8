"""The options that describe a design."""

from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.config import parse
from myograph.ensemble.design import DesignSpec
from myograph.errors import InputError

DesignMethod = Annotated[
    str | None,
    typer.Option("--design", help="factorial, tenths, sobol, latin_hypercube, sparse_grid or list."),
]
Step = Annotated[float | None, typer.Option(help="factorial: 1.0 makes 32 cases, 0.5 makes 243.")]
Count = Annotated[int | None, typer.Option(help="tenths, sobol, latin_hypercube: number of cases.")]
Seed = Annotated[int | None, typer.Option(help="tenths, sobol, latin_hypercube: same seed, same cases.")]
Level = Annotated[int | None, typer.Option(help="sparse_grid: 1, 11, 71, 351, 1471, ... cases.")]
File = Annotated[Path | None, typer.Option("--cases", help="list: CSV file, a column for each muscle.")]
Load = Annotated[str | None, typer.Option(help="Weight in the hand: a number, or LOW:HIGH for a further dimension.")]
Angle = Annotated[
    str | None, typer.Option(help="Prescribed elbow angle: a number, or LOW:HIGH. Without it the arm finds its rest.")
]
_RANGES = ("hand_load_n", "elbow_angle_deg")


def asked_design(options: dict[str, Any]) -> DesignSpec | None:
    """The design of the options that are not None; None where there is none of them."""
    given = {name: value for name, value in options.items() if value is not None}
    ranges = {name: _range(name, given[name]) for name in _RANGES if name in given}
    return parse({**given, **ranges}, DesignSpec, "design") if given else None


def _range(name: str, text: str) -> float | tuple[float, ...]:
    try:
        numbers = tuple(float(part) for part in text.split(":"))
    except ValueError:
        numbers = ()
    if len(numbers) not in (1, 2):
        raise InputError(f"{name}: expected a number or LOW:HIGH, got '{text}'")
    return numbers[0] if len(numbers) == 1 else numbers
