"""The report of the reproduction: complete, self-contained, escaped, in the order of the chapter."""

from myograph.evaluation import Figure
from myograph.evaluation.experiments.chapter import SECTIONS
from myograph.evaluation.experiments.page import Made, chapter_page, write_chapter
from tests.evaluation.test_page import PNG, Page

ROWS = [
    {"name": "a<b", "protocol": "strict", "mean_mm": 1.5, "max_mm": 4.0},
    {"name": "gone", "left_out": "needs the package 'x'"},
]


def made(**changes):
    told = {"rows": ROWS, "figures": (Figure("A <b>.", PNG, "a"),), "seconds": 3.0, "provenance": {"seeds": "0"}}
    return Made(**(told | changes))


def test_sections_stand_in_the_order_of_the_chapter():
    page = chapter_page("Title", {"edge": made(), "6.2.4": made(), "6.2.1": made()}, {"command": "x"})
    places = [page.index(SECTIONS[name].heading) for name in ("6.2.1", "6.2.4", "edge")]
    assert places == sorted(places)
    assert SECTIONS["6.2.2"].heading not in page


def test_a_section_shows_its_table_its_figures_and_what_the_thesis_found():
    page = chapter_page("Title", {"6.2.2": made()}, {})
    parsed = Page(page)
    assert ["method", "strict, mm", "strict, max"] in parsed.rows
    assert ["a<b", "1.5", "4"] in parsed.rows
    assert ["gone", "needs the package 'x'"] in parsed.rows
    assert "5.5 mm, much as with coordinates." in parsed.texts
    assert [attributes["alt"] for tag, attributes in parsed.elements if tag == "img"] == ["a"]
    assert "A <b>." in parsed.texts


def test_what_the_thesis_concludes_is_judged_first():
    names = ("16, latent 1", "32-32, latent 32")
    errors = (10.0, 5.0)
    rows = [
        {"name": name, "protocol": "thesis", "mean_mm": error, "mean_mm_seeds": [error, error]}
        for name, error in zip(names, errors, strict=True)
    ]
    page = chapter_page("Title", {"6.2.4": made(rows=rows)}, {})
    evidence = (
        "10 mm (16, latent 1), 5 mm (32-32, latent 32), thesis: 2 times (2 to 2 over 2 seeds); "
        "holds for at least 1.1 times"
    )
    assert ["A latent space of 1 is worse", "6.2.4", "holds", evidence] in Page(page).rows
    assert page.index("What of the thesis holds here") < page.index(SECTIONS["6.2.4"].heading)
    assert "What of the thesis holds here" not in chapter_page("Title", {"6.2.2": made()}, {})


def test_the_page_needs_nothing_outside_itself(tmp_path):
    write_chapter("Title", {name: made() for name in SECTIONS}, {"command": "x"}, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert "http:" not in page
    assert "https:" not in page
    for tag, attributes in Page(page).elements:
        assert tag not in ("script", "link", "iframe", "base")
        assert attributes.get("src", "data:").startswith("data:")
