"""Columns of the tables: one figure under one protocol, or one figure of the method."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

Row = Mapping[str, Any]
PROTOCOLS = ("thesis", "strict", "off_grid")
NOTHING, LEAST, THOUSANDS = "–", 0.001, 999.5


@dataclass(frozen=True)
class Column:
    """A figure of a method.

    Parameters
    ----------
    key
        Of a row.
    protocol
        Under which; None for what belongs to the method: to what `off_grid` tests, where `strict` teaches another one.
    """

    heading: str
    key: str
    protocol: str | None = None


def _errors(unit: str, mean: str, largest: str) -> tuple[Column, ...]:
    means = tuple(Column(f"{protocol}, {unit}", mean, protocol) for protocol in PROTOCOLS)
    worst = tuple(Column(f"{protocol}, max", largest, protocol) for protocol in ("strict", "off_grid"))
    return means + worst


POSITION = (*_errors("mm", "mean_mm", "max_mm"), Column("strict, relative", "relative", "strict"))
STRESS = (
    *_errors("MPa", "von_mises_mean_mpa", "von_mises_max_mpa"),
    Column("strict, relative", "von_mises_relative", "strict"),
)
SKIN = (Column("thesis, skin, mm", "skin_mean_mm", "thesis"), Column("thesis, skin, max", "skin_max_mm", "thesis"))
COST = (
    Column("taught by", "taught", "off_grid"),
    Column("strict, taught by", "taught", "strict"),
    Column("seeds", "seeds"),
    Column("stored numbers", "stored"),
    Column("learning, s", "seconds"),
)
WEIGHT = (
    Column("weights, kB", "weights_kb"),
    Column("ONNX, kB", "onnx_kb"),
    Column("C, kB", "c_kb"),
    Column("C in int8, kB", "c_int8_kb"),
    Column("ONNX, ms", "onnx_ms"),
    Column("C, ms", "c_ms"),
    Column("multiply-adds", "multiply_adds"),
)


def cells(rows: Sequence[Row], columns: Sequence[Column]) -> list[list[str]]:
    """A line for each name: the name, then its figures; a reason takes the place of all figures."""
    lines = []
    for name in dict.fromkeys(row["name"] for row in rows):
        own = [row for row in rows if row["name"] == name]
        reason = next((row["left_out"] for row in own if "left_out" in row), None)
        lines.append([name, *([reason] if reason else (_cell(own, column) for column in columns))])
    return lines


def known(rows: Sequence[Row], columns: Sequence[Column]) -> list[Column]:
    """The columns of which some row has a figure."""
    return [column for column in columns if any(_cell(own, column) != NOTHING for own in _by_name(rows))]


def number(value: float) -> str:
    """Three significant digits; thousands in groups; what is less than a thousandth is only said to be."""
    if 0 < abs(value) < LEAST:
        return f"< {LEAST}"
    return f"{value:,.0f}" if abs(value) >= THOUSANDS else f"{value:.3g}"


def _by_name(rows: Sequence[Row]) -> list[list[Row]]:
    return [[row for row in rows if row["name"] == name] for name in dict.fromkeys(row["name"] for row in rows)]


def _cell(own: Sequence[Row], column: Column) -> str:
    for row in own:
        if column.key in row and column.protocol in (None, row.get("protocol")):
            spread = row.get(f"{column.key}_std")
            return number(row[column.key]) + (f" ± {number(spread)}" if spread is not None else "")
    return NOTHING
