"""The page on interpolation: its example runs and its counts are right."""

import re
from pathlib import Path

import pytest

from myograph.interpolation import BASES, SparseGrid

PAGE = (Path(__file__).parents[2] / "docs" / "interpolation.md").read_text()


def test_the_example_runs_and_gives_what_its_comments_say():
    namespace = {}
    exec(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)[0], namespace)
    spline, place = namespace["spline"], namespace["np"].array([75.0, 0.5])
    assert spline(place) == pytest.approx([0.408, 37.5], abs=5e-4)
    assert spline.gradient(place)[0] == pytest.approx([-0.0050, -0.408], abs=1e-3)
    assert spline.gradient(place)[1] == pytest.approx([0.5, 75], rel=1e-3)


@pytest.mark.parametrize(
    ("row", "dimension", "boundary"), [("d = 2", 2, 0), ("d = 2, boundary", 2, 1), ("d = 5", 5, 0)]
)
def test_the_sizes_of_the_grids_are_right(row, dimension, boundary):
    sizes = [len(SparseGrid.regular(dimension, level, bool(boundary))) for level in range(1, 7)]
    assert f"| points, {row} | " + " | ".join(f"{size:,}" for size in sizes) in PAGE


def test_every_basis_stands_in_the_table():
    assert re.findall(r"^\| `(\w+)` \|", PAGE, re.MULTILINE) == list(BASES)
