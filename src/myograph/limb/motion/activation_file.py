"""Activations over time from a file: CSV, or OpenSim's .sto.

CSV: a header `time,biceps,triceps,…`, then rows. STO: lines up to `endheader`, then the same, separated by tabs or
blanks; `nRows` of the header is checked. Muscles are found by their exact names, or by names given in a map; a muscle
without a column stays at rest, which is noted. Between rows activations are linear, after the last row they stay.
"""

import difflib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError

Row = tuple[int, list[str]]


@dataclass(frozen=True)
class Activations:
    """Activations over time.

    Parameters
    ----------
    times
        Increasing [s], at least two.
    values
        In [0, 1].
    notes
        What the file left open.
    """

    muscles: tuple[str, ...]
    times: Float[np.ndarray, " times"]
    values: Float[np.ndarray, "times muscles"]
    notes: tuple[str, ...] = field(default=())

    def at(self, time: float) -> Float[np.ndarray, " muscles"]:
        """Activations at a time [s], linear between the rows; before and after them those of the ends."""
        k = int(np.clip(self.times.searchsorted(time, side="right") - 1, 0, len(self.times) - 2))
        share = min(max((time - self.times[k]) / (self.times[k + 1] - self.times[k]), 0.0), 1.0)
        return (1 - share) * self.values[k] + share * self.values[k + 1]

    def every(self, step: float) -> "Activations":
        """The same with rows between, so that no two are further apart than `step` [s]."""
        if not step > 0:
            raise InputError(f"step: expected a time above 0 s, got {step:g}")
        pieces = [
            np.linspace(a, b, max(1, math.ceil((b - a) / step - 1e-9)), endpoint=False)
            for a, b in pairwise(self.times.tolist())
        ]
        times = np.concatenate([*pieces, self.times[-1:]])
        values = np.stack([np.interp(times, self.times, column) for column in self.values.T], axis=1)
        return Activations(self.muscles, times, values, self.notes)


def read_activations(path: Path, muscles: Sequence[str], renamed: Mapping[str, str] | None = None) -> Activations:
    """Activations of these muscles, in this order; 0 for those that the file does not have.

    Parameters
    ----------
    renamed
        Column -> muscle, for files with other names; an empty muscle leaves the column out.

    Raises InputError, with file and line, for everything that is not as described above.
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as problem:
        raise InputError(f"{path}: cannot be read as text ({problem})") from None
    rows = _sto_rows(path, lines) if path.suffix.lower() == ".sto" else _csv_rows(lines)
    if not rows:
        raise InputError(f"{path}: expected a header 'time,{','.join(muscles)}' and rows, got an empty file")
    columns = _columns(path, rows[0], muscles, renamed or {})
    if len(rows) < 3:
        raise InputError(f"{path}: expected at least 2 rows of numbers, got {len(rows) - 1}")
    numbers = np.array([_numbers(path, row, rows[0][1]) for row in rows[1:]])
    _check_times(path, numbers[:, 0], [number for number, _ in rows[1:]])
    values = np.zeros((len(numbers), len(muscles)))
    for place, column in columns.items():
        values[:, place] = numbers[:, column]
        outside = np.flatnonzero(~((values[:, place] >= 0) & (values[:, place] <= 1)))
        if len(outside):
            line, value = rows[1 + outside[0]][0], values[outside[0], place]
            raise InputError(f"{path}, line {line}: {muscles[place]}: expected an activation in [0, 1], got {value:g}")
    absent = [name for place, name in enumerate(muscles) if place not in columns]
    notes = (f"no column for {', '.join(absent)}: taken as 0",) if absent else ()
    return Activations(tuple(muscles), numbers[:, 0], values, notes)


def _csv_rows(lines: Sequence[str]) -> list[Row]:
    """Line numbers and cells; lines that are empty or begin with # are left out."""
    kept = [(number, line) for number, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    return [(number, [cell.strip().strip('"') for cell in line.split(",")]) for number, line in kept]


def _sto_rows(path: Path, lines: Sequence[str]) -> list[Row]:
    """The same of what follows `endheader`; raises InputError where it is missing, or rows are."""
    end = next((k for k, line in enumerate(lines) if line.strip().lower() == "endheader"), None)
    if end is None:
        raise InputError(f"{path}: expected a line 'endheader', as OpenSim writes it, got none")
    rows = [(number, line.split()) for number, line in enumerate(lines[end + 1 :], end + 2) if line.strip()]
    for number, line in enumerate(lines[:end], 1):
        key, _, value = line.partition("=")
        if key.strip().lower() == "nrows" and value.strip() != str(len(rows) - 1):
            raise InputError(f"{path}, line {number}: expected {value.strip()} rows, got {len(rows) - 1}")
    return rows


def _columns(path: Path, header: Row, muscles: Sequence[str], renamed: Mapping[str, str]) -> dict[int, int]:
    """Place of a muscle -> column of the file."""
    number, names = header
    if names[0].lower() != "time":
        raise InputError(f"{path}, line {number}: expected the first column to be 'time', got '{names[0]}'")
    for name in renamed:
        if name not in names:
            raise InputError(f"{path}, line {number}: expected a column '{name}', as the map says, got none")
    columns: dict[int, int] = {}
    for column, name in enumerate(names[1:], 1):
        muscle = renamed.get(name, name)
        if not muscle:
            continue
        if muscle not in muscles:
            raise InputError(f"{path}, line {number}: unknown muscle '{muscle}': {_hint(muscle, muscles)}")
        if muscles.index(muscle) in columns:
            raise InputError(f"{path}, line {number}: expected one column for {muscle}, got two")
        columns[muscles.index(muscle)] = column
    if not columns:
        raise InputError(f"{path}, line {number}: expected a column of a muscle ({', '.join(muscles)}), got none")
    return columns


def _hint(name: str, muscles: Sequence[str]) -> str:
    near = difflib.get_close_matches(name, muscles, n=1, cutoff=0.5)
    return f"did you mean '{near[0]}'?" if near else f"expected one of {', '.join(muscles)}, or a map of names"


def _numbers(path: Path, row: Row, header: Sequence[str]) -> list[float]:
    number, cells = row
    if len(cells) != len(header):
        raise InputError(f"{path}, line {number}: expected {len(header)} cells, got {len(cells)}")
    values = []
    for name, cell in zip(header, cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise InputError(f"{path}, line {number}: {name}: expected a number, got '{cell}'")
        values.append(value)
    return values


def _check_times(path: Path, times: Float[np.ndarray, " times"], lines: Sequence[int]) -> None:
    bad = np.flatnonzero(np.diff(times) <= 0)
    if len(bad):
        k = int(bad[0])
        raise InputError(
            f"{path}, line {lines[k + 1]}: expected a time after {times[k]:g} s (line {lines[k]}), got {times[k + 1]:g}"
        )
