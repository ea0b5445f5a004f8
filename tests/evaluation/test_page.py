"""The report as a page: complete, self-contained, escaped, never half written."""

import base64
import errno
from html.parser import HTMLParser
from pathlib import Path

import pytest

from myograph.errors import InputError
from myograph.evaluation import ErrorSummary, Figure, Report, write_report
from myograph.evaluation.page import duration, report_page

PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)
METHODS = ("do_nothing", "affine", "thin_plate_spline", "gen_8", "gen_343")
PROTOCOLS = ("thesis", "strict", "off_grid")
VOID = {"meta", "img", "br", "link"}


def summary(mean: float) -> ErrorSummary:
    return ErrorSummary(mean, 1.5 * mean, 2 * mean, 4 * mean, mean / 20)


def report(**changes) -> Report:
    errors = {m: {p: summary(20 / (k + 1) + j) for j, p in enumerate(PROTOCOLS)} for k, m in enumerate(METHODS)}
    content = {
        "title": "The biceps",
        "summary": ("It was simulated.", "It was learned.", "It was measured."),
        "errors": errors,
        "figures": (Figure("The arm, bent.", PNG, "an arm"),),
        "times": {"training gen_8": 61.2},
        "provenance": {"command": "myograph demo --seed 0"},
        "notes": ("One arm only.",),
    }
    return Report(**(content | changes))


class Page(HTMLParser):
    """Elements and texts of a page; fails on a tag that is not closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict]] = []
        self.open: list[str] = []
        self.rows: list[list[str]] = []
        self.texts: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.append(data)
        if {"td", "th"} & set(self.open):
            self.rows[-1][-1] += data


def test_a_page_needs_nothing_outside_itself():
    text = report_page(report())
    assert "http:" not in text
    assert "https:" not in text
    assert "url(" not in text
    for tag, attributes in Page(text).elements:
        assert tag not in ("script", "link", "iframe", "base")
        assert "href" not in attributes
        assert attributes.get("src", "data:").startswith("data:")


def test_a_picture_in_the_page_is_the_picture_given():
    images = [attributes for tag, attributes in Page(report_page(report())).elements if tag == "img"]
    assert len(images) == 1
    assert images[0]["alt"] == "an arm"
    assert base64.b64decode(images[0]["src"].removeprefix("data:image/png;base64,")) == PNG


def test_every_method_has_a_row_under_every_protocol():
    page = Page(report_page(report()))
    rows = [row for row in page.rows if len(row) == 6 and row[0] != "method"]
    assert len(rows) == len(METHODS) * len(PROTOCOLS)
    for method in METHODS:
        assert sum(row[0].startswith(method) for row in rows) == len(PROTOCOLS)
    first = rows[0]
    assert first[1:] == ["20.00", "30.00", "40.00", "80.00", "1.00"]


def test_the_least_figure_of_each_column_is_marked_and_no_other():
    page = Page(report_page(report()))
    marked = [row for row in page.rows if any("●" in cell for cell in row)]
    assert [row[0][:7] for row in marked] == ["gen_343"] * len(PROTOCOLS)
    assert all("●" in cell for row in marked for cell in row[1:])


def test_a_method_without_a_protocol_shows_dashes_there():
    errors = {"affine": {"thesis": summary(2.0), "strict": summary(3.0)}, "gen_8": {"thesis": summary(1.0)}}
    rows = Page(report_page(report(errors=errors))).rows
    assert rows[-1][1:] == ["–"] * 5
    assert "●" in rows[-2][1]


def test_stresses_and_coverage_have_columns_only_where_a_method_knows_them():
    knowing = ErrorSummary(1.0, 1.5, 2.0, 4.0, 0.1, von_mises_mean_mpa=0.25, von_mises_max_mpa=3.0, coverage_90=0.91)
    errors = {"affine": {"strict": summary(2.0)}, "gen_8": {"strict": knowing}}
    head, *rows = Page(report_page(report(errors=errors))).rows[-3:]
    assert head[6:] == ["von Mises, mean [MPa]", "von Mises, maximum [MPa]", "within 90 % interval"]
    assert rows[0][6:] == ["–", "–", "–"]
    assert rows[1][6:] == ["● 0.25", "● 3.00", "0.91"]


def test_each_known_protocol_is_explained():
    text = report_page(report())
    assert text.count("tests new") == 3
    assert "new pairings, not new shapes" in text


def test_everything_a_caller_writes_is_escaped():
    nasty = '<b onload="x">&\''
    page = report_page(
        report(
            title=nasty,
            summary=(nasty,),
            errors={nasty: {nasty: summary(1.0)}},
            figures=(Figure(nasty, PNG, nasty),),
            times={nasty: 1.0},
            provenance={nasty: nasty},
            notes=(nasty,),
        )
    )
    parsed = Page(page)
    assert "b" not in {tag for tag, _ in parsed.elements}
    assert all("onload" not in attributes for _, attributes in parsed.elements)
    assert sum(nasty in text for text in parsed.texts) == 10
    assert next(a for tag, a in parsed.elements if tag == "img")["alt"] == nasty


def test_sections_without_content_are_left_out():
    page = Page(report_page(Report("Title", ("One sentence.",), {})))
    assert not {"h2", "table", "figure", "dl", "ul"} & {tag for tag, _ in page.elements}


def test_a_page_follows_light_and_dark_and_fits_a_phone():
    text = report_page(report())
    assert "prefers-color-scheme: dark" in text
    assert "width=device-width" in text


def test_a_written_report_is_the_page_and_nothing_else_is_left(tmp_path: Path):
    path = tmp_path / "new" / "report.html"
    write_report(report(), path)
    assert path.read_text(encoding="utf-8") == report_page(report())
    assert list(path.parent.iterdir()) == [path]


def test_a_full_disk_leaves_the_old_report_and_no_half_one(tmp_path: Path, monkeypatch):
    path = tmp_path / "report.html"
    path.write_text("old")

    def full(self: Path, target: Path) -> Path:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(InputError, match=r"report\.html.*No space left"):
        write_report(report(), path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_report_cannot_replace_a_folder(tmp_path: Path):
    path = tmp_path / "report.html"
    path.mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        write_report(report(), path)
    assert list(tmp_path.iterdir()) == [path]


def test_a_report_below_a_file_is_refused(tmp_path: Path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write_report(report(), tmp_path / "file" / "report.html")


def test_a_figure_must_be_a_png():
    with pytest.raises(InputError, match="'The arm': expected a PNG image"):
        Figure("The arm", b"GIF89a", "an arm")


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.00421, "4.21 ms"), (1.0, "1 s"), (61.25, "61.2 s"), (99.6, "1.66 min"), (812.3, "13.5 min")],
)
def test_durations_are_in_the_unit_that_fits(seconds, words):
    assert duration(seconds) == words
