"""Measured sensors from a CSV file, a row for each.

Columns: `node`, or its place in the reference body `place_x_mm place_y_mm place_z_mm`; and where it is now, `x_mm y_mm
z_mm`.
"""

from pathlib import Path

import numpy as np
from jaxtyping import Float, Shaped

from myograph.ensemble.csv_rows import Row, number, read_rows
from myograph.errors import InputError

NODE, PLACE, NOW = ("node",), ("place_x_mm", "place_y_mm", "place_z_mm"), ("x_mm", "y_mm", "z_mm")
MOST = 2**53
"""Numbers of nodes beyond are no longer told apart."""


def read_sensors(path: Path) -> tuple[Shaped[np.ndarray, "sensors ..."], Float[np.ndarray, "sensors 3"]]:
    """Nodes, or places in the reference body [mm], and positions [mm]; raises InputError with file and line."""
    columns, rows = read_rows(path)
    named = _named_by(path, columns)
    if not rows:
        raise InputError(f"{path}: expected at least one sensor, got none")
    numbers = np.array([_row(f"{path}, line {line}", row, named) for line, row in rows])
    where, now = numbers[:, : len(named)], numbers[:, len(named) :]
    return (where[:, 0].astype(np.int64) if named == NODE else where), now


def _named_by(path: Path, columns: list[str]) -> tuple[str, ...]:
    for named in (NODE, PLACE):
        if sorted(columns) == sorted((*named, *NOW)):
            return named
    wanted = " or ".join(", ".join((*named, *NOW)) for named in (NODE, PLACE))
    raise InputError(f"{path}: expected the columns {wanted}, each once, got {', '.join(columns) or 'none'}")


def _row(place: str, row: Row, named: tuple[str, ...]) -> list[float]:
    try:
        numbers = [number(row[name]) for name in (*named, *NOW)]
    except ValueError as problem:
        raise InputError(f"{place}: expected a number in every column: {problem}") from None
    if not np.isfinite(numbers).all():
        raise InputError(f"{place}: expected finite numbers, got {numbers}")
    if named == NODE and (numbers[0] != int(numbers[0]) or abs(numbers[0]) > MOST):
        raise InputError(f"{place}: expected the number of a node, got {numbers[0]}")
    return numbers
