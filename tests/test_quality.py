"""What the code promises about itself: style, types, imports, and a conventions page that lists every field."""

import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

from myograph.fields import FIELDS

ROOT = Path(__file__).parents[1]
SCRIPTS = Path(sysconfig.get_path("scripts"))


@pytest.mark.parametrize(
    "command",
    [
        ("ruff", "check", "."),
        ("ruff", "format", "--check", "."),
        ("pyright", "--pythonpath", sys.executable),
        ("lint-imports",),
    ],
    ids=["ruff", "format", "pyright", "import contracts"],
)
def test_the_sources_pass(command):
    done = subprocess.run([SCRIPTS / command[0], *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_conventions_list_every_field_with_its_unit():
    page = (ROOT / "docs" / "conventions.md").read_text()
    for field in FIELDS.values():
        unit = field.unit.replace("*", "·")
        assert f"| {field.name} | {unit} | {field.lives_on} | {' '.join(field.components)}" in page


def test_no_file_is_longer_than_one_idea_allows():
    longest = max((len(path.read_text().splitlines()), path) for path in (ROOT / "src").rglob("*.py"))
    assert longest[0] <= 250, longest
