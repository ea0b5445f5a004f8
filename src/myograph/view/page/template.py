"""The built page, `template.html` beside this module, and how numbers are put into it.

It is made of `web/` by `npm --prefix web ci && npm --prefix web run build`, which an installation does by itself where
npm is there; it is no file of the repository.
"""

from html import escape
from importlib.resources import files

from myograph.errors import InputError
from myograph.view.page.content import PageContent

TEMPLATE = "template.html"
DATA, NUMBERS, TITLE = "@@MYOGRAPH_DATA@@", "@@MYOGRAPH_NUMBERS@@", "<title>myograph</title>"


def read_template() -> str:
    """The built page; raises InputError where this installation has none, or a damaged one."""
    path = files("myograph.view.page") / TEMPLATE
    if not path.is_file():
        raise InputError(
            "this installation has no built page: it was made without npm. Install Node.js 20 or newer, then, in the"
            " checkout,  npm --prefix web ci && npm --prefix web run build"
        )
    text = path.read_text(encoding="utf-8")
    if any(text.count(mark) != 1 for mark in (DATA, NUMBERS, TITLE)):
        raise InputError(f"{path}: not the built page; make it anew:  npm --prefix web run build")
    return text


def filled_page(template: str, content: PageContent) -> str:
    """The page with its numbers."""
    before, rest = template.split(DATA)
    middle, after = rest.split(NUMBERS)
    whole = "".join([before, content.data, middle, content.numbers, after])
    return whole.replace(TITLE, f"<title>{escape(content.title)}</title>", 1)
