"""The page of the documentation: it lists every check as it is, and its snippet runs."""

import re
from pathlib import Path

import pytest

pytest.importorskip("ngsolve", reason="verification needs NGSolve")

from myograph.verification.table import CHECKS

PAGE = (Path(__file__).parents[2] / "docs" / "verification.md").read_text()


def test_the_page_lists_every_check_with_its_quantity_and_tolerance():
    rows = re.findall(r"^\| ([a-z_]+\.\w+) \| (.+?) \|.*\| (\S+) \|$", PAGE, flags=re.MULTILINE)
    listed = {name: (what, float(tolerance)) for name, what, tolerance in rows}
    assert list(listed) == [check.name for check in CHECKS]
    for check in CHECKS:
        what, tolerance = listed[check.name]
        assert check.what.removesuffix(" [-]") == what.removesuffix(" [-]")
        assert check.tolerance == tolerance


def test_the_snippet_runs():
    (snippet,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    names = {}
    exec(snippet, names)
    state = names["state"]
    assert state.mean_gradient[0, 0] == pytest.approx(1.1, rel=1e-9)
    assert state.displacement_at((10.0, 2.0, 1.0))[0] == pytest.approx(1.0)
    assert state.reactions["x_max"][0] > 0
