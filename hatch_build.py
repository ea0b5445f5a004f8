"""Builds the page of `web/` into the package where npm is there; without npm the installation goes on without it.

`myograph view` then says what is missing. A page that is newer than all its sources is kept.
"""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

TEMPLATE = Path("src/myograph/view/page/template.html")
STEPS = (("ci", "--no-audit", "--no-fund"), ("run", "build"))
SECONDS = 600


class BuildPage(BuildHookInterface):
    """Makes the template and puts it into the wheel, though git ignores it."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build where that is needed and possible."""
        root = Path(self.root)
        if not _fresh(root):
            self._build(root)
        if (root / TEMPLATE).is_file():
            build_data["artifacts"].append(f"/{TEMPLATE.as_posix()}")

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
    template, web = root / TEMPLATE, root / "web"
    if not template.is_file():
        return False
    sources = [web / "index.html", *web.glob("*.json"), *web.glob("*.ts"), *(web / "src").glob("*")]
    return all(path.stat().st_mtime <= template.stat().st_mtime for path in sources if path.is_file())


def get_build_hook() -> type[BuildHookInterface]:
    """For hatchling."""
    return BuildPage
