"""The section 'edge': what is tried, and which model it calls the smallest within the limit."""

import pytest

from myograph.cli.reproduce.cache import Found
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.sections import edge
from myograph.cli.reproduce.sections.edge import CHOICES, SMALLEST, figures, rows


def test_the_learning_curve_has_each_choice_at_each_count_from_as_many_seeds(data):
    curve = [trial for trial in edge.trials(data, data.size) if trial.drawn is not None]
    drawn = sorted((trial.method, trial.drawn.count, trial.drawn.by, trial.seed) for trial in curve)
    choices = [*(("pod_gp", 8, by) for by in CHOICES), ("neural_modes", 8, "random")]
    assert drawn == sorted((*choice, seed) for choice in choices for seed in range(data.size.seeds))
    assert {trial.teaching for trial in curve} == {"off_grid"}
    assert len({trial.key({"ensemble": "x"}) for trial in curve}) == len(curve)


@pytest.mark.parametrize(("errors", "within"), [((0.4, 0.6), False), ((0.4, 0.5), True), ((0.6, 0.1), False)])
def test_the_smallest_model_is_within_the_limit_under_both_protocols(data, errors, within):
    trials = [trial for trial in edge.trials(data, data.size) if trial.drawn is None]
    of_protocol = {"off_grid": {"thesis": 9.0, "off_grid": errors[0]}, "strict": {"strict": errors[1]}}
    outcomes = []
    for trial in trials:
        mean = of_protocol[trial.teaching] if trial.method == "neural_modes" else {"thesis": 9.0, "off_grid": 9.0}
        mean = mean if trial.method == "neural_modes" or trial.teaching == "off_grid" else {"strict": 9.0}
        told = {"protocols": {protocol: {"mean_mm": value} for protocol, value in mean.items()}}
        outcomes.append(Found({**told, "seconds": 1.0, "weights_kb": 2.0}))
    names = [row["name"] for row in rows(Outcome(data, data.size, trials, outcomes, {}))]
    smallest = [name for name in names if name.startswith(SMALLEST)]
    assert smallest == [f"{SMALLEST}: neural_modes, 1 mode"] * (3 if within else 0)


@pytest.mark.parametrize(("lost", "drawn"), [((), 2), (("gen",), 2), (("gen", "neural_modes"), 1)])
def test_what_could_not_be_weighed_is_left_out_of_the_figures(data, lost, drawn):
    trials = edge.trials(data, data.size)
    gone = {trial.name for trial in trials if trial.drawn is None and trial.method in lost}
    told = {"protocols": {p: {"mean_mm": 1.0} for p in ("thesis", "strict", "off_grid")}, "weights_kb": 2.0}
    outcomes = [None if trial.name in gone else Found(told) for trial in trials]
    outcome = Outcome(data, data.size, trials, outcomes, dict.fromkeys(gone, "no onnx"))
    assert len(figures(outcome)) == drawn
    assert {row["name"] for row in rows(outcome) if "left_out" in row} == gone
