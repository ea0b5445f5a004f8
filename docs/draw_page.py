"""The pictures of docs/page.md: the pages of the shipped arm and of the shipped network in Debian's chromium.

    python docs/draw_page.py [--truth STORE]

Needs the packages playwright and pillow, chromium, and the built page.
"""

import argparse
import io
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

HERE = Path(__file__).parent
FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--ignore-gpu-blocklist"]
FLEXED = "[0.6, 0.7, 0.8, 0, 0]"
SHOWN = {
    "relaxed": "set([0, 0, 0, 0, 0], 0), myograph.page.show('muscle')",
    "active": f"set({FLEXED}, 0), myograph.page.show('displacement')",
    "stress": f"set({FLEXED}, 0), myograph.page.show('von_mises')",
    "deviation": f"set({FLEXED}, 0), myograph.page.show('deviation')",
    "outside": f"set({FLEXED}, 50), myograph.page.show('muscle')",
}
NETWORK = """new Promise(done => {
    const { page } = myograph, { network } = page.arm;
    page.set([0.6, 0.7, 0.8, 0, 0], 0);
    page.drawBy('difference');
    for (const name of ['9 sensors', '8 learned nodes']) {
        [...document.querySelectorAll('.check')].find(check => check.textContent === `its ${name}`).click();
    }
    document.activeElement.blur();
    const look = () => network.settled ? done() : setTimeout(look, 20);
    look(); })"""
COLOURS = 256
FRAMES = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))"


def main() -> None:
    """Write the page aside, open it, take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--truth", type=Path)
    asked = parser.parse_args()
    chromium = shutil.which("chromium")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as started:
        path, network = Path(folder) / "page.html", Path(folder) / "network.html"
        truth = [] if asked.truth is None else ["--truth", str(asked.truth)]
        _write(path, *truth)
        _write(network, "gen-biceps")
        browser = started.chromium.launch(executable_path=chromium, args=FLAGS)
        page = browser.new_page(viewport={"width": 1100, "height": 760})
        _open(page, path)
        for name, call in SHOWN.items():
            page.evaluate(f"myograph.page.{call}")
            _keep(page, name)
        if truth:
            page.evaluate("myograph.page.show('error'), myograph.page.compare('4')")
            _keep(page, "error")
        _open(page, network)
        page.evaluate(NETWORK)
        _keep(page, "network")
        context = browser.new_context(
            viewport={"width": 390, "height": 780}, is_mobile=True, has_touch=True, color_scheme="dark"
        )
        phone = context.new_page()
        _open(phone, path)
        phone.evaluate(f"myograph.page.{SHOWN['stress']}")
        _keep(phone, "phone")
        browser.close()


def _write(path: Path, *words: str) -> None:
    subprocess.run([sys.executable, "-m", "myograph", "view", *words, "--out", str(path)], check=True)


def _open(page: Page, path: Path) -> None:
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-state=ready]", timeout=60_000)


def _keep(page: Page, name: str) -> None:
    page.evaluate(FRAMES)
    image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    image.quantize(COLOURS).save(HERE / f"page-{name}.png", optimize=True)


if __name__ == "__main__":
    main()
