"""Cases from a CSV file: a column for each muscle, and optionally `hand_load_n`, `elbow_angle_deg` and `design`."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from myograph.case import MUSCLES, Case
from myograph.ensemble.csv_rows import number, read_rows
from myograph.errors import InputError
from myograph.units import radians

_OPTIONAL = ("hand_load_n", "elbow_angle_deg", "design")


def read_cases(path: Path, word: str, repeats: bool = False) -> tuple[list[Case], list[str]]:
    """Cases and their words, `word` where the file has none; raises InputError with file and line.

    A case that is there twice is refused, unless `repeats` says that the rows are a sequence.
    """
    columns, rows = read_rows(path)
    _check_columns(path, columns)
    if not rows:
        raise InputError(f"{path}: expected at least one case, got none")
    cases = [_case(path, line, row) for line, row in rows]
    first: dict[Case, int] = {}
    for (line, _), case in zip(rows, cases, strict=True):
        if case in first and not repeats:
            raise InputError(f"{path}, line {line}: expected every case once, got that of line {first[case]} again")
        first[case] = line
    return cases, [(row.get("design") or word)[:16] for _, row in rows]


def _check_columns(path: Path, found: Sequence[str]) -> None:
    missing = [name for name in MUSCLES if name not in found]
    foreign = [name for name in found if name not in (*MUSCLES, *_OPTIONAL)]
    if missing or foreign or len(set(found)) != len(found):
        raise InputError(
            f"{path}: expected the columns {', '.join(MUSCLES)}, if wanted {', '.join(_OPTIONAL)}, each once,"
            f" got {', '.join(found) or 'none'}"
        )


def _case(path: Path, line: int, row: Mapping[str, str]) -> Case:
    try:
        angle = row.get("elbow_angle_deg")
        return Case(
            tuple(number(row[name]) for name in MUSCLES),
            number(row.get("hand_load_n") or "0"),
            radians(number(angle)) if angle else None,
        )
    except (ValueError, InputError) as problem:
        raise InputError(f"{path}, line {line}: {problem}") from None
