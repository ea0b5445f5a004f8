"""Results in Markdown; docs/results*.md say what docs/results*.json say."""

import json
from pathlib import Path

import pytest

from myograph.errors import InputError
from myograph.evaluation.experiments.chapter import SECTIONS, about
from myograph.evaluation.experiments.results import file_name, joined, results_page

DOCS = Path(__file__).parents[3] / "docs"
RESULTS = {
    "preset": "tiny",
    "provenance": {"versions": "numpy 2"},
    "sections": {
        "6.2.2": {
            "rows": [{"name": "a", "protocol": "strict", "mean_mm": 1.5}],
            "seconds": 61.0,
            "provenance": {"seeds": "0"},
        }
    },
}


def test_a_section_becomes_a_table():
    page = results_page(RESULTS)
    assert "## 6.2.2 Learning the direction vector" in page
    assert "| method | strict, mm |\n| --- | --- |\n| a | 1.5 |" in page
    assert "`myograph reproduce --preset tiny`" in page
    assert "Time of all trainings: 61 s; seeds 0." in page
    assert "## Mesh size" not in page
    assert "not made in this run: 6.2.1, 6.2.3" in page


def test_how_long_networks_were_trained_is_told_at_the_head():
    told = {**RESULTS, "provenance": {"training steps": "graphs of 8 nodes 60"}}
    assert "\nTraining steps: graphs of 8 nodes 60.\n" in results_page(told).split("## ")[0]
    assert "Training steps" not in results_page(RESULTS)


def test_what_the_thesis_concludes_is_judged():
    section = {"rows": [row("gen_thesis_343, displacement", 1.0), row("gen_thesis_343, coordinates", 2.0)]}
    page = results_page(RESULTS | {"sections": {"6.2.2": section | {"seconds": 1.0}}})
    assert "## What of the thesis holds here" in page
    assert "| 6.2.2 | does not hold | 1 mm (gen_thesis_343, displacement), 2 mm" in page
    assert "What of the thesis holds" not in results_page(RESULTS)


def row(name, error):
    return {"name": name, "protocol": "thesis", "mean_mm": error, "mean_mm_seeds": [error, error]}


def test_results_of_something_else_are_refused():
    with pytest.raises(InputError, match="expected sections, got none"):
        results_page({"preset": "tiny", "provenance": {}})


def test_an_unknown_section_is_refused():
    with pytest.raises(InputError, match=r"section '6\.2\.9': expected one of 6\.2\.1"):
        about("6.2.9")


def test_sections_of_a_run_take_the_place_of_those_before():
    again = {"rows": [row("a", 3.0)], "seconds": 2.0}
    later = {"preset": "tiny", "provenance": {"versions": "numpy 3"}, "sections": {"direct": again}}
    found = joined(RESULTS, later)
    assert list(found["sections"]) == ["6.2.2", "direct"]
    assert found["provenance"] == {"versions": "numpy 3"}
    assert found["sections"]["6.2.2"]["provenance"] == {"versions": "numpy 2", "seeds": "0"}
    assert found["sections"]["direct"] == again
    assert joined(found, RESULTS)["sections"]["6.2.2"] == RESULTS["sections"]["6.2.2"]
    assert joined(RESULTS, RESULTS) == RESULTS


@pytest.mark.parametrize(
    "other",
    [{**RESULTS, "preset": "quick"}, *({**RESULTS, "provenance": {key: "another"}} for key in ("arm", "size"))],
    ids=["preset", "arm", "size"],
)
def test_results_of_another_preset_arm_or_size_are_not_joined(other):
    with pytest.raises(InputError, match="expected those of"):
        joined({**RESULTS, "provenance": {"arm": "a", "size": "b"}}, other)


@pytest.mark.parametrize("told", sorted(DOCS.glob("results*.json")), ids=lambda path: path.stem)
def test_the_page_of_results_says_what_the_results_say(told):
    results = json.loads(told.read_text())
    assert told.stem == file_name(results["preset"])
    assert told.with_suffix(".md").read_text() == results_page(results), "run python docs/write_results.py"
    assert set(results["sections"]) <= set(SECTIONS)


def test_there_are_results_of_the_preset_that_anyone_can_make():
    assert json.loads((DOCS / "results.json").read_text())["preset"] == "quick"
