"""Every law has its page: parameters, a picture, and a snippet that works."""

import importlib.util
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

from myograph.config import Model, parse
from myograph.materials.catalogue import LAWS, AnyLaw

DOCS = Path(__file__).parents[2] / "docs"
PAGES = DOCS / "laws"
LARGEST_PICTURE = 60_000

names = pytest.mark.parametrize("name", LAWS)


class _Snippet(Model):
    law: AnyLaw


def _drawing():
    spec = importlib.util.spec_from_file_location("draw_laws", DOCS / "draw_laws.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@names
def test_the_page_names_every_parameter_and_shows_its_picture(name):
    page = (PAGES / f"{name}.md").read_text(encoding="utf-8")
    table = "\n".join(line for line in page.splitlines() if line.startswith("| `"))
    documented = set(re.findall(r"`(\w+)`", " ".join(line.split("|")[1] for line in table.splitlines())))
    assert documented == set(LAWS[name].model_fields) - {"law"}
    assert f"]({name}.png)" in page
    for heading in ("Energy", "Parameters", "Convention", "Trap", "Source"):
        assert f"\n## {heading}\n" in page


@names
def test_the_snippet_of_the_page_is_that_law(name):
    page = (PAGES / f"{name}.md").read_text(encoding="utf-8")
    (snippet,) = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    assert parse({"law": tomllib.loads(snippet)}, _Snippet, name).law.law == name


@names
def test_the_index_lists_the_law(name):
    assert f"| [{name}]({name}.md) |" in (PAGES / "README.md").read_text(encoding="utf-8")


def test_there_is_no_page_without_a_law():
    pages = {path.stem for path in PAGES.glob("*.md")} - {"README"}
    assert pages == {path.stem for path in PAGES.glob("*.png")} == set(LAWS)


@names
def test_the_picture_is_small(name):
    picture = (PAGES / f"{name}.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert len(picture) < LARGEST_PICTURE


def test_the_pictures_draw_every_law_at_its_own_stress():
    """A bar's force is that of its fibres and its matrix; the sheet of each law is of that law."""
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    drawing = _drawing()
    sheets = drawing.sheets()
    assert {name: sheet.law.law for name, sheet in sheets.items()} == {name: name for name in LAWS}
    assert drawing.draw(sheets["gauss"]).startswith(b"\x89PNG")
    rubber, stretch = sheets["mooney_rivlin"].law, np.array([0.8, 1.3])
    closed = 2 * (stretch - stretch**-2) * (rubber.c1 + rubber.c2 / stretch)
    assert drawing.bar_stress(rubber, stretch, 0.0) == pytest.approx(closed, rel=2e-3)
    assert drawing.fibre_stress(rubber, "active", stretch) == pytest.approx(rubber.active_stress * stretch, rel=1e-6)
