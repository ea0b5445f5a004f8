"""Rows of the comparison as a Markdown table, and the page around it."""

COLUMNS = (
    "mean_mm",
    "p95_mm",
    "max_mm",
    "von_mises_mean_mpa",
    "train_s",
    "steps",
    "predict_ms",
    "numbers",
    "install_mb",
    "reads",
    "anywhere",
)
PAGE = """# Peers, one run

Written by `compare.py` from [peers.json](peers.json): means over {seeds} seed(s) and, after ±, the sample standard
deviation; one thread each; data {data}.
What is trained by steps (`steps`) stops at {seconds:g} s, to a step; the others take the time that they take. The limit
and `train_s` are the processor's seconds, so that a busy machine takes nothing from anybody ({load:.0f} jobs at once as
this ended); `predict_ms` is by the clock on the wall.
`mean_shape` is what knowing nothing gives: few `steps` and an error near that one show the limit, not the method.
What is alike and what is not: [README.md](README.md). `install_mb` is the package alone, without what it depends on.

"""


def page(told: dict[str, object]) -> str:
    """The table with what it was made from."""
    rows: list[dict[str, object]] = told["rows"]  # type: ignore[assignment]
    return PAGE.format(**told) + table(rows) + "\n"


def table(rows: list[dict[str, object]]) -> str:
    """Markdown."""
    lines = [["method", "protocol", *COLUMNS], ["---"] * (len(COLUMNS) + 2)]
    for row in rows:
        told = [f"not measured: {row['reason']}"] if "reason" in row else [_cell(row, key) for key in COLUMNS]
        lines.append([_name(row), str(row["protocol"]), *told])
    return "\n".join("| " + " | ".join(cell.replace("|", r"\|") for cell in line) + " |" for line in lines)


def _name(row: dict[str, object]) -> str:
    answered, asked = row.get("answered"), row.get("asked")
    return f"{row['name']}" if answered == asked else f"{row['name']} ({answered} of {asked} seeds)"


def _cell(row: dict[str, object], key: str) -> str:
    value, spread = _short(row.get(key)), row.get(f"{key}_std")
    return value if spread is None else f"{value} ± {_short(spread)}"


def _short(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and abs(value) < 999.5:
        return f"{value:.3g}"
    return f"{value:,.0f}" if isinstance(value, int | float) else str(value)
