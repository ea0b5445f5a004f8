"""Cases from a CSV file: a column for each muscle, and optionally `hand_load_n`, `elbow_angle_deg` and `design`."""

import csv
from collections.abc import Mapping
from pathlib import Path

from myograph.case import MUSCLES, Case
from myograph.errors import InputError
from myograph.units import radians

_OPTIONAL = ("hand_load_n", "elbow_angle_deg", "design")


def read_cases(path: Path, word: str) -> tuple[list[Case], list[str]]:
    """Cases and their words, `word` where the file has none; raises InputError with file and line."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            _check_columns(path, reader.fieldnames or [])
            rows = [(reader.line_num, row) for row in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as problem:
        raise InputError(f"{path}: not a readable CSV file: {problem}") from None
    if not rows:
        raise InputError(f"{path}: expected at least one case, got none")
    cases = [_case(path, line, row) for line, row in rows]
    first: dict[Case, int] = {}
    for (line, _), case in zip(rows, cases, strict=True):
        if case in first:
            raise InputError(f"{path}, line {line}: expected every case once, got that of line {first[case]} again")
        first[case] = line
    return cases, [(row.get("design") or word)[:16] for _, row in rows]


def _check_columns(path: Path, names: object) -> None:
    found = list(names) if isinstance(names, list | tuple) else []
    missing = [name for name in MUSCLES if name not in found]
    foreign = [name for name in found if name not in (*MUSCLES, *_OPTIONAL)]
    if missing or foreign or len(set(found)) != len(found):
        raise InputError(
            f"{path}: expected the columns {', '.join(MUSCLES)}, if wanted {', '.join(_OPTIONAL)}, each once,"
            f" got {', '.join(map(str, found)) or 'none'}"
        )


def _case(path: Path, line: int, row: Mapping[str, str | None]) -> Case:
    try:
        angle = row.get("elbow_angle_deg")
        return Case(
            tuple(float(row[name] or "") for name in MUSCLES),
            float(row.get("hand_load_n") or 0),
            radians(float(angle)) if angle else None,
        )
    except (ValueError, TypeError, InputError) as problem:
        raise InputError(f"{path}, line {line}: {problem}") from None
