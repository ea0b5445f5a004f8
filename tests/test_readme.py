"""The README tells what a run printed, not what somebody typed."""

import json
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
COLUMNS = (
    ("thesis", "mean_mm"),
    ("strict", "mean_mm"),
    ("strict", "p95_mm"),
    ("strict", "max_mm"),
    ("off_grid", "mean_mm"),
)


def test_the_errors_in_the_readme_are_those_of_the_run_beside_it():
    run = json.loads((ROOT / "docs" / "demo-quick.json").read_text())
    readme = (ROOT / "README.md").read_text()
    for method, row in run["methods"].items():
        figures = " | ".join(f"{row[protocol][key]:.2f}" for protocol, key in COLUMNS)
        assert f"| `{method}` | {figures} |" in readme


def test_the_readme_gives_the_two_commands_that_set_everything_up():
    readme = (ROOT / "README.md").read_text()
    assert 'python -m pip install -c constraints.txt -e ".[all]" && myograph demo' in readme
    assert 'python -m pip install -c constraints.txt -e ".[all,test]" && pytest' in readme


def test_the_network_is_asked_from_other_languages_by_the_names_that_it_has():
    told = json.loads((ROOT / "src" / "myograph" / "models" / "biceps" / "model.json").read_text())["model"]
    text = (ROOT / "docs" / "models.md").read_text()
    sharp, script = (text.split(f"```{language}\n")[1].split("```")[0] for language in ("csharp", "js"))
    assert set(re.findall(r'CreateFromTensor\("(\w+)"', sharp)) == set(told["signature"]["inputs"])
    assert set(re.findall(r"(\w+): new ort.Tensor", script)) == set(told["signature"]["inputs"])


def test_every_file_that_the_readme_links_is_there():
    for link in re.findall(r"\]\(([^)#]+)\)", (ROOT / "README.md").read_text()):
        assert (ROOT / link).exists(), link
