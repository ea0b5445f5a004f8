"""The report as one HTML file that opens anywhere, offline, with everything inside it.

Images are inlined as data, the style sheet too; there are no scripts and no addresses of other files. Every text is
escaped. The frame `page.html` and its style `page.css` lie beside this module.
"""

import base64
from collections.abc import Iterable, Mapping
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template

from myograph.evaluation.report import Figure, Report
from myograph.evaluation.table import error_tables
from myograph.files import write_whole


def write_report(report: Report, path: Path) -> None:
    """Write the report as HTML to `path`; it appears whole or not at all."""
    page = report_page(report).encode()
    write_whole(path, lambda file: file.write(page))


def report_page(report: Report) -> str:
    """HTML of the whole report; sections without content are left out."""
    sections = [
        _section("Errors", error_tables(report.errors)),
        _section("Pictures", "\n".join(_figure(figure) for figure in report.figures)),
        _section("Times", _terms({name: duration(seconds) for name, seconds in report.times.items()})),
        _section("How to do it again", _terms(report.provenance)),
        _section("Limits", _items(report.notes)),
    ]
    here = files("myograph.evaluation")
    return Template((here / "page.html").read_text(encoding="utf-8")).substitute(
        title=escape(report.title),
        style=(here / "page.css").read_text(encoding="utf-8"),
        summary="\n".join(f"<p>{escape(sentence)}</p>" for sentence in report.summary),
        sections="\n".join(sections),
    )


def duration(seconds: float) -> str:
    """Time in words: milliseconds, seconds or minutes, with three significant figures."""
    if seconds < 1:
        return f"{1000 * seconds:.3g} ms"
    return f"{seconds:.3g} s" if seconds < 99.5 else f"{seconds / 60:.3g} min"


def _section(heading: str, content: str) -> str:
    return f"<section>\n<h2>{heading}</h2>\n{content}\n</section>" if content else ""


def _figure(figure: Figure) -> str:
    data = base64.b64encode(figure.png).decode("ascii")
    image = f'<img alt="{escape(figure.alt)}" src="data:image/png;base64,{data}">'
    return f"<figure>\n{image}\n<figcaption>{escape(figure.caption)}</figcaption>\n</figure>"


def _terms(terms: Mapping[str, str]) -> str:
    rows = "\n".join(f"<dt>{escape(term)}</dt><dd>{escape(meaning)}</dd>" for term, meaning in terms.items())
    return f"<dl>\n{rows}\n</dl>" if rows else ""


def _items(texts: Iterable[str]) -> str:
    items = "\n".join(f"<li>{escape(text)}</li>" for text in texts)
    return f"<ul>\n{items}\n</ul>" if items else ""
