"""The cases of another program's data: a CSV file whose columns the mapping names."""

from pathlib import Path

from myograph.case import MUSCLES, Case
from myograph.ensemble.csv_rows import Row, number, read_rows
from myograph.ensemble.design.cases import Design
from myograph.ensemble.importing.mapping import CasesMapping
from myograph.errors import InputError
from myograph.units import radians

_FURTHER = ("hand_load_n", "elbow_angle_deg", "design")


def read_table(path: Path, mapping: CasesMapping) -> tuple[Design, list[Row]]:
    """The cases, and the rows as they stand in the file; raises InputError with file and line."""
    found, rows = read_rows(path)
    columns = _columns(path, mapping, found)
    if not rows:
        raise InputError(f"{path}: expected at least one case, got none")
    cases = []
    for line, row in rows:
        try:
            cases.append(_case(row, columns, mapping.absent))
        except (ValueError, InputError) as problem:
            raise InputError(f"{path}, line {line}: {problem}") from None
    words = [(row.get(columns.get("design", "")) or mapping.design)[:16] for _, row in rows]
    try:
        return Design(tuple(cases), tuple(words)), [row for _, row in rows]
    except InputError as problem:
        raise InputError(f"{path}: {problem}") from None


def _columns(path: Path, mapping: CasesMapping, found: list[str]) -> dict[str, str]:
    """Our name -> column, of those that there are."""
    known = (*MUSCLES, *_FURTHER)
    for name, column in mapping.columns.items():
        if name not in known or column not in found:
            raise InputError(
                f"{path}: cases.columns: expected one of {', '.join(known)} and a column of the file"
                f" ({', '.join(found) or 'none'}), got {name} = '{column}'"
            )
    columns = {name: name for name in known if name in found} | mapping.columns
    missing = [name for name in MUSCLES if name not in columns]
    if missing and mapping.absent is None:
        raise InputError(
            f"{path}: expected a column for {', '.join(missing)}; name it in cases.columns, or set cases.absent"
        )
    return columns


def _case(row: Row, columns: dict[str, str], absent: float | None) -> Case:
    activations = tuple(number(row[columns[name]]) if name in columns else absent or 0.0 for name in MUSCLES)
    angle = row[columns["elbow_angle_deg"]] if "elbow_angle_deg" in columns else ""
    load = row[columns["hand_load_n"]] if "hand_load_n" in columns else ""
    return Case(activations, number(load or "0"), radians(number(angle)) if angle else None)
