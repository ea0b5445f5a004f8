"""Builds the page of `web/` into the package where npm is there; without npm the installation goes on without it.

`myograph view` then says what is missing. A page that is newer than all its sources is kept.
"""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FOLDER = Path("src/myograph/view/page")
BUILT = (FOLDER / "template.html", FOLDER / "runtime.html")
"""The page, and what a page with a network needs besides."""
STEPS = (("ci", "--no-audit", "--no-fund"), ("run", "build"))
SECONDS = 600


class BuildPage(BuildHookInterface):
    """Makes the page's files and puts them into the wheel, though git ignores them."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build where that is needed and possible."""
        root = Path(self.root)
        if not _fresh(root):
            self._build(root)
        for path in BUILT:
            if (root / path).is_file():
                build_data["artifacts"].append(f"/{path.as_posix()}")

    def _build(self, root: Path) -> None:
        npm = shutil.which("npm")
        if npm is None or not (root / "web" / "package.json").is_file():
            self.app.display_warning("no npm: the page of 'myograph view' is left out")
            return
        try:
            for step in STEPS:
                subprocess.run([npm, "--prefix", str(root / "web"), *step], check=True, timeout=SECONDS)
        except (OSError, subprocess.SubprocessError) as problem:
            self.app.display_warning(f"the page of 'myograph view' is left out: {problem}")


def _fresh(root: Path) -> bool:
    web = root / "web"
    if not all((root / path).is_file() for path in BUILT):
        return False
    built = min((root / path).stat().st_mtime for path in BUILT)
    sources = [
        web / "index.html",
        *web.glob("*.json"),
        *web.glob("*.ts"),
        *web.glob("*.mjs"),
        *(web / "src").rglob("*"),
    ]
    return all(path.stat().st_mtime <= built for path in sources if path.is_file())


def get_build_hook() -> type[BuildHookInterface]:
    """For hatchling."""
    return BuildPage
