"""The reproduction as one HTML file, laid out like the thesis's chapter 6; it needs nothing outside itself."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from myograph.evaluation.experiments.chapter import SECTIONS
from myograph.evaluation.experiments.claims import TOLD, Verdict, judged
from myograph.evaluation.experiments.columns import Column, Row, cells, known
from myograph.evaluation.page import duration, figure_html, framed, terms_html
from myograph.evaluation.report import Figure
from myograph.files import write_whole

SUMMARY = (
    "Chapter 6 of the thesis again, on data that anyone can make: each experiment with its table and figures, then the "
    "questions that the thesis left open.",
    "Figures of the thesis are of its own arm, which is not published, and whose displacements it does not give: "
    "errors cannot be compared with ours, ratios of two errors can.",
)
PROTOCOLS = {
    "thesis": "pairs whose initial state was never one in training; every target was seen there: new pairings",
    "strict": "pairs among corners of the cube of activations that training never saw: new shapes",
    "off_grid": "pairs among activations anywhere between 0 and 1: new shapes between the corners",
}


@dataclass(frozen=True)
class Made:
    """A section that was made: its rows, its pictures, the time of its trainings [s], and how to do it again."""

    rows: Sequence[Row]
    figures: Sequence[Figure]
    seconds: float
    provenance: Mapping[str, str]


def write_chapter(title: str, made: Mapping[str, Made], provenance: Mapping[str, str], path: Path) -> None:
    """Write the page; it appears whole or not at all."""
    page = chapter_page(title, made, provenance).encode()
    write_whole(path, lambda file: file.write(page))


def chapter_page(title: str, made: Mapping[str, Made], provenance: Mapping[str, str]) -> str:
    """HTML of all sections that were made, in the order of the chapter."""
    parts = [_part("6.1 Description", _description())]
    if verdicts := judged({name: one.rows for name, one in made.items()}):
        parts.append(_part("What of the thesis holds here", _verdicts(verdicts)))
    parts += [_part(about.heading, _section(name, made[name])) for name, about in SECTIONS.items() if name in made]
    parts.append(_part("How to do it again", terms_html(provenance)))
    return framed(title, SUMMARY, "\n".join(parts))


def _description() -> str:
    told = (
        "The biceps of a finite-element arm with five muscles, each case at the equilibrium of the elbow. Sensors are "
        "nodes whose place is known; all others are asked. Every table has three protocols:"
    )
    return f"<p>{told}</p>\n{terms_html(PROTOCOLS, 'said')}"


def _verdicts(verdicts: Sequence[Verdict]) -> str:
    lines = "\n".join(
        f'<tr><th scope="row">{escape(one.claim.said)}</th><td>{escape(one.claim.section)}</td>'
        f"<td>{escape(one.verdict)}</td><td>{escape(one.evidence)}</td></tr>"
        for one in verdicts
    )
    head = "".join(f'<th scope="col">{name}</th>' for name in ("the thesis", "section", "here", "evidence"))
    table = (
        f'<div class="wide told"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{lines}\n</tbody>\n</table></div>'
    )
    return f"<p>{escape(TOLD)}</p>\n{table}"


def _section(name: str, made: Made) -> str:
    about = SECTIONS[name]
    beside = {"asked": about.question, "the thesis found": about.thesis, "ours": about.ours}
    pictures = "\n".join(figure_html(figure) for figure in made.figures)
    how = {**made.provenance, "time of all trainings": duration(made.seconds)}
    table = _table(made.rows, known(made.rows, about.columns))
    return "\n".join([terms_html(beside, "said"), table, pictures, terms_html(how)])


def _table(rows: Sequence[Row], columns: Sequence[Column]) -> str:
    head = "".join(f'<th scope="col">{escape(column.heading)}</th>' for column in columns)
    body = "\n".join(_line(line, len(columns)) for line in cells(rows, columns))
    return (
        f'<div class="wide many"><table>\n<thead><tr><th scope="col">method</th>{head}</tr></thead>\n'
        f"<tbody>\n{body}\n</tbody>\n</table></div>"
    )


def _line(line: list[str], columns: int) -> str:
    name, *figures = line
    if len(figures) == 1 < columns:
        told = f'<td colspan="{columns}">{escape(figures[0])}</td>'
    else:
        told = "".join(f"<td>{escape(figure)}</td>" for figure in figures)
    return f'<tr><th scope="row"><code>{escape(name)}</code></th>{told}</tr>'


def _part(heading: str, content: str) -> str:
    return f"<section>\n<h2>{escape(heading)}</h2>\n{content}\n</section>"
