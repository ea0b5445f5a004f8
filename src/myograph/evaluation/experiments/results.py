"""Results as they lie on disk, and what is said of them in Markdown: docs/results*.md are written by this alone."""

from collections.abc import Mapping
from typing import Any

from myograph.errors import InputError
from myograph.evaluation.experiments.chapter import SECTIONS, About
from myograph.evaluation.experiments.claims import TOLD, judged
from myograph.evaluation.experiments.columns import Row, cells, known
from myograph.evaluation.page import duration

Results = Mapping[str, Any]
"""`sections` (name -> `rows`, `seconds`), `provenance`, and `preset`, as `myograph reproduce` writes them."""
HEAD = """# Results, preset {preset}

Written by `python docs/write_results.py` from [{name}.json]({name}.json), which
`myograph reproduce --preset {preset}` wrote; no number here was typed by hand. How it is made:
[reproduce.md](reproduce.md). Methods: [baselines.md](baselines.md), [gen.md](gen.md), [modes.md](modes.md). Protocols:
[pairs.md](pairs.md).

Errors are distances of nodes of the biceps, means over all nodes and test pairs unless a column says otherwise. Where
split, sensors and training have several seeds, rows are means over them, ± the sample standard deviation; outside 6.2.1
`strict` is taught by the first of them alone. 'Max' is the largest of all that were tested, larger with more seeds.
Stored numbers and times are of what `thesis` and `off_grid` test: `strict` has a model of its own. Times leave out
trainings that were interrupted. 'Relative' is the mean error over the mean displacement, which doing nothing misses by
1 (stress: over the mean stress). Figures of the thesis are of its own arm, whose displacements it does not give: what
can be compared with ours are ratios of two of its errors. A dash: not answered, tested or measured.
"""


def check_results(results: Results) -> None:
    """Raise InputError for what is no results of this version."""
    missing = [key for key in ("preset", "sections", "provenance") if key not in results]
    if missing:
        raise InputError(f"results: expected {', '.join(missing)}, got none; write them with 'myograph reproduce'")


def joined(before: Results, results: Results) -> Results:
    """Results, with the sections that they lack out of those before; what was said of that run stays with each.

    Raises InputError where the two are not of one preset, or tell of two arms or sizes.
    """
    run = results["provenance"]
    pairs = {"preset": (before["preset"], results["preset"])}
    pairs |= {key: (before["provenance"].get(key, run.get(key)), run.get(key)) for key in ("arm", "size")}
    for key, (old, new) in pairs.items():
        if old != new:
            raise InputError(f"results: expected those of {key} {old}, got {new}; make all sections again")
    told = {k: v for k, v in before["provenance"].items() if k not in ("last command", "preset") and run.get(k) != v}
    kept = {
        name: {**found, "provenance": {**told, **found.get("provenance", {})}}
        for name, found in before["sections"].items()
        if name not in results["sections"]
    }
    sections = {**kept, **results["sections"]}
    return {**results, "sections": {name: sections[name] for name in SECTIONS if name in sections}}


def file_name(preset: str) -> str:
    """Of the page and its JSON in docs, without an ending: those of the preset that anyone can make are plain."""
    return "results" if preset == "quick" else f"results-{preset}"


def results_page(results: Results) -> str:
    """The page in Markdown."""
    check_results(results)
    preset = results["preset"]
    parts = [HEAD.format(preset=preset, name=file_name(preset))]
    if trained := results["provenance"].get("training steps"):
        parts.append(f"Training steps: {trained}.\n")
    absent = [name for name in SECTIONS if name not in results["sections"]]
    if absent:
        parts.append(f"Sections that were not made in this run: {', '.join(absent)}.\n")
    parts += _verdicts({name: found["rows"] for name, found in results["sections"].items()})
    for name, about in SECTIONS.items():
        if name in results["sections"]:
            found = results["sections"][name]
            parts.append(_section(about, found))
    parts.append(
        "## How to do it again\n\n" + "\n".join(f"- {k}: {v}" for k, v in results["provenance"].items()) + "\n"
    )
    return "\n".join(parts)


def _verdicts(sections: Mapping[str, list[Row]]) -> list[str]:
    lines = [f"| {v.claim.said} | {v.claim.section} | {v.verdict} | {v.evidence} |" for v in judged(sections)]
    head = "| the thesis | section | here | evidence |\n| --- | --- | --- | --- |\n"
    return ["## What of the thesis holds here\n\n" + TOLD + "\n\n" + head + "\n".join(lines) + "\n"] if lines else []


def _section(about: About, found: Mapping[str, Any]) -> str:
    rows: list[Row] = found["rows"]
    columns = known(rows, about.columns)
    head = ["method", *(column.heading for column in columns)]
    lines = [head, ["---"] * len(head), *cells(rows, columns)]
    table = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    told = f"{about.question} The thesis: {about.thesis}"
    made = "; ".join(f"{key} {value}" for key, value in found.get("provenance", {}).items())
    how = f"{about.ours} Time of all trainings: {duration(found['seconds'])}; {made}."
    return f"## {about.heading}\n\n{told}\n\n{how}\n\n{table}\n"
