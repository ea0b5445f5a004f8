"""Tables of cases as CSV files: every row as wide as the header, and known by its line."""

import csv
from pathlib import Path

from myograph.errors import InputError

Row = dict[str, str]


def read_rows(path: Path) -> tuple[list[str], list[tuple[int, Row]]]:
    """The columns, and the rows with their line numbers; raises InputError with file and line."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file, strict=True)
            columns = list(reader.fieldnames or [])
            rows = [(reader.line_num, row) for row in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as problem:
        raise InputError(f"{path}: not a readable CSV file: {problem}") from None
    for line, row in rows:
        if None in row or None in row.values():
            raise InputError(f"{path}, line {line}: expected {len(columns)} columns, got another number")
    return columns, rows


def number(text: str) -> float:
    """What a cell says; raises ValueError for anything but a number as other programs write it, too."""
    if "_" in text:
        raise ValueError(f"expected a number, got '{text}'")
    return float(text)
