"""The page of the documentation: its snippet runs, its file is read."""

import re
from pathlib import Path

import pytest

from myograph.limb.force_limb import read_force_limb

PAGE = (Path(__file__).parents[2] / "docs" / "limb.md").read_text()


def test_the_snippet_runs_and_gives_what_it_says():
    (snippet,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    names = {}
    exec(snippet, names)
    assert names["rest"].stable
    assert names["found"].activations == pytest.approx((0.498, 0.0), abs=5e-4)


def test_the_example_of_a_limb_file_is_one(tmp_path):
    (example,) = re.findall(r"```toml\n(.*?)```", PAGE, flags=re.DOTALL)
    path = tmp_path / "limb.toml"
    path.write_text(example)
    spec = read_force_limb(path)
    assert list(spec.muscles) == ["triceps", "biceps"]
    assert spec.dynamics is not None
    assert spec.weights is not None
