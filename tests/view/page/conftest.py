"""Debian's chromium, and the built page."""

import shutil

import pytest

from myograph.errors import InputError
from myograph.view.page import read_template
from tests.view.page.opening import FLAGS


@pytest.fixture(scope="module")
def chromium():
    """Path of the system's chromium."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs the package playwright")
    path = shutil.which("chromium") or shutil.which("chromium-browser")
    if path is None:
        pytest.skip("needs Debian's chromium: apt-get install chromium")
    with playwright.sync_playwright() as started:
        yield lambda *flags: started.chromium.launch(executable_path=path, args=[*FLAGS, *flags])


@pytest.fixture(scope="module")
def template():
    try:
        return read_template()
    except InputError as missing:
        pytest.skip(str(missing))


@pytest.fixture(scope="module")
def browser(chromium):
    found = chromium()
    yield found
    found.close()
