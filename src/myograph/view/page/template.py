"""The built page, `template.html` beside this module, and how numbers are put into it.

`runtime.html` is what a page with a network has besides: onnxruntime-web as a worker and its WebAssembly, which are
text of the page until the network is asked for. Only such a page may compile WebAssembly.

Both are made of `web/` by `npm --prefix web ci && npm --prefix web run build`, which an installation does by itself
where npm is there; they are no files of the repository.
"""

from html import escape
from importlib.resources import files

from myograph.errors import InputError
from myograph.view.page.content import PageContent

TEMPLATE, RUNTIME = "template.html", "runtime.html"
DATA, NUMBERS, TITLE = "@@MYOGRAPH_DATA@@", "@@MYOGRAPH_NUMBERS@@", "<title>myograph</title>"
ENGINE = "<!--@@MYOGRAPH_RUNTIME@@-->"
SCRIPTS = "script-src 'unsafe-inline'"
WITH_WORKER = f"{SCRIPTS} 'wasm-unsafe-eval' blob:; worker-src blob:"
"""What the page's policy allows to run; with a network also a worker that the page makes, and WebAssembly."""


def read_template() -> str:
    """The built page; raises InputError where this installation has none, or a damaged one."""
    return _read(TEMPLATE, (DATA, NUMBERS, TITLE, ENGINE, SCRIPTS))


def read_runtime() -> str:
    """What runs a network in the page; raises InputError where this installation has none, or a damaged one."""
    return _read(RUNTIME, ("myograph-worker", "myograph-wasm"))


def filled_page(template: str, content: PageContent, runtime: str = "") -> str:
    """The page with its numbers, and with what runs its network where it has one."""
    before, rest = template.split(DATA)
    middle, after = rest.split(NUMBERS)
    before = before.replace(TITLE, f"<title>{escape(content.title)}</title>", 1)
    if content.network is not None:
        before = before.replace(SCRIPTS, WITH_WORKER, 1)
    after = after.replace(ENGINE, runtime if content.network is not None else "", 1)
    return "".join([before, content.data, middle, content.numbers, after])


def _read(name: str, marks: tuple[str, ...]) -> str:
    path = files("myograph.view.page") / name
    if not path.is_file():
        raise InputError(
            f"this installation has no built page ({name}): it was made without npm. Install Node.js 20 or newer, then,"
            " in the checkout,  npm --prefix web ci && npm --prefix web run build"
        )
    text = path.read_text(encoding="utf-8")
    if any(text.count(mark) != 1 for mark in marks):
        raise InputError(f"{path}: not the built page; make it anew:  npm --prefix web run build")
    return text
