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
        _section("Pictures", "\n".join(figure_html(figure) for figure in report.figures)),
        _section("Times", terms_html({name: duration(seconds) for name, seconds in report.times.items()})),
        _section("How to do it again", terms_html(report.provenance)),
        _section("Limits", _items(report.notes)),
    ]
    return framed(report.title, report.summary, "\n".join(sections))


def framed(title: str, summary: Iterable[str], sections: str) -> str:
    """A page of sections that are HTML already, in the common frame and style."""
    here = files("myograph.evaluation")
    return Template((here / "page.html").read_text(encoding="utf-8")).substitute(
        title=escape(title),
        style=(here / "page.css").read_text(encoding="utf-8"),
        summary="\n".join(f"<p>{escape(sentence)}</p>" for sentence in summary),
        sections=sections,
    )


def duration(seconds: float) -> str:
    """Time in words: milliseconds, seconds or minutes, with three significant figures."""
    if seconds < 1:
        return f"{1000 * seconds:.3g} ms"
    return f"{seconds:.3g} s" if seconds < 99.5 else f"{seconds / 60:.3g} min"


def _section(heading: str, content: str) -> str:
    return f"<section>\n<h2>{heading}</h2>\n{content}\n</section>" if content else ""


def figure_html(figure: Figure) -> str:
    """A picture with its caption, the image inside."""
    data = base64.b64encode(figure.png).decode("ascii")
    image = f'<img alt="{escape(figure.alt)}" src="data:image/png;base64,{data}">'
    return f"<figure>\n{image}\n<figcaption>{escape(figure.caption)}</figcaption>\n</figure>"


def terms_html(terms: Mapping[str, str], style: str = "") -> str:
    """Terms and what they mean; `style` is a class of the style sheet."""
    rows = "\n".join(f"<dt>{escape(term)}</dt><dd>{escape(meaning)}</dd>" for term, meaning in terms.items())
    opening = f'<dl class="{escape(style)}">' if style else "<dl>"
    return f"{opening}\n{rows}\n</dl>" if rows else ""


def _items(texts: Iterable[str]) -> str:
    items = "\n".join(f"<li>{escape(text)}</li>" for text in texts)
    return f"<ul>\n{items}\n</ul>" if items else ""
