"""Tables of errors as HTML: one per protocol, a row per method, the least figure of each column marked."""

from collections.abc import Mapping
from html import escape

from myograph.evaluation.summary import ErrorSummary

PROTOCOLS = {
    "thesis": "Pairs of states whose first was never a first in training, while every second was seen there: tests new "
    "pairings, not new shapes.",
    "strict": "Pairs among states that training never saw in either role: tests new shapes, at corners of the cube of "
    "activations.",
    "off_grid": "Pairs among states with activations anywhere between 0 and 1, while training knew only 0 and 1: tests "
    "new shapes between the corners.",
}
METHODS = {
    "do_nothing": "every node stays",
    "affine": "one affine map, fitted to the sensors",
    "thin_plate_spline": "a spline through the sensors",
    "gen_8": "graph element network, 2 × 2 × 2 nodes",
    "gen_343": "graph element network, 7 × 7 × 7 nodes",
}
COLUMNS = {
    "mean_mm": "mean",
    "rmse_mm": "RMSE",
    "p95_mm": "95th percentile",
    "max_mm": "maximum",
    "relative": "relative",
    "von_mises_mean_mpa": "von Mises, mean",
    "von_mises_max_mpa": "von Mises, maximum",
    "coverage_90": "within 90 % interval",
}
"""Of each only where a method of the table knows it."""
UNMARKED = ("coverage_90",)
"""Less is not better there."""
LEGEND = (
    "Distance of a predicted node from its true place, over all nodes of all test pairs: mean, root mean square, 95th "
    "percentile and maximum in mm. Relative is the mean over the mean displacement: 1 is as good as predicting that "
    "nothing moves. Errors of von Mises stress in MPa, and the share of position errors within the 90 % interval that "
    "a method gives, stand where a method gives them. A dot marks the least of a column."
)


def error_tables(errors: Mapping[str, Mapping[str, ErrorSummary]]) -> str:
    """HTML of method -> protocol -> errors; empty where there are none."""
    protocols = dict.fromkeys(protocol for summaries in errors.values() for protocol in summaries)
    tables = [_table(protocol, errors) for protocol in protocols]
    return "\n".join([f"<p>{LEGEND}</p>", *tables]) if tables else ""


def _table(protocol: str, errors: Mapping[str, Mapping[str, ErrorSummary]]) -> str:
    tested = [summaries[protocol] for summaries in errors.values() if protocol in summaries]
    found = {column: [v for summary in tested if (v := getattr(summary, column)) is not None] for column in COLUMNS}
    best = {column: None if column in UNMARKED else min(values) for column, values in found.items() if values}
    meaning = f"<p>{PROTOCOLS[protocol]}</p>" if protocol in PROTOCOLS else ""
    head = "".join(f'<th scope="col">{COLUMNS[column]}{_unit(column)}</th>' for column in best)
    rows = "\n".join(_row(method, summaries.get(protocol), best) for method, summaries in errors.items())
    return (
        f"<h3>Protocol <code>{escape(protocol)}</code></h3>\n{meaning}\n"
        f'<div class="wide"><table>\n<thead><tr><th scope="col">method</th>{head}</tr></thead>\n'
        f"<tbody>\n{rows}\n</tbody>\n</table></div>"
    )


def _unit(column: str) -> str:
    unit = {"_mm": "mm", "mpa": "MPa"}.get(column[-3:])
    return f" <small>[{unit}]</small>" if unit else ""


def _row(method: str, summary: ErrorSummary | None, best: Mapping[str, float | None]) -> str:
    """Name and figures of a method; dashes where it was not tested, or does not answer."""
    meaning = f"<small>{METHODS[method]}</small>" if method in METHODS else ""
    cells = [_cell(None if summary is None else getattr(summary, column), least) for column, least in best.items()]
    return f'<tr><th scope="row"><code>{escape(method)}</code>{meaning}</th>{"".join(cells)}</tr>'


def _cell(value: float | None, best: float | None) -> str:
    if value is None:
        return "<td>–</td>"
    return f'<td class="best">● {value:.2f}</td>' if value == best else f"<td>{value:.2f}</td>"
