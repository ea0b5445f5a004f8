"""Trials are made once, errors keep what is finished, and a missing package leaves a row with its reason."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.cli.progress import Steps
from myograph.cli.reproduce import runner as running
from myograph.cli.reproduce import weighing
from myograph.cli.reproduce.cache import Cache, Found
from myograph.cli.reproduce.experiment import corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome, finished, table_rows
from myograph.cli.reproduce.runner import Runner
from myograph.cli.reproduce.trial import Chosen, Drawn, Trial
from myograph.cli.reproduce.trying import cases_of, run_trial, split_of
from myograph.errors import InputError, MissingPackageError


@pytest.fixture
def runner(data, tmp_path):
    cache = Cache(tmp_path / "cache")
    cache.prepare()
    return Runner(data, cache, Steps())


def plain(data, *methods):
    return [trial for method in methods for trial in taught_twice(method, method, corners(data), data.size)]


def test_a_trial_is_made_once(runner, data, here):
    first = table_rows(runner.run("a", plain(data, "do_nothing", "affine")))
    assert here == ["do_nothing", "do_nothing", "affine", "affine"]
    second = table_rows(runner.run("b", plain(data, "affine", "do_nothing")))
    assert len(here) == 4
    assert sorted(first, key=str) == sorted(second, key=str)


def test_every_row_has_all_protocols_and_doing_nothing_has_relative_error_1(runner, data, here):
    rows = table_rows(runner.run("a", plain(data, "do_nothing")))
    assert [row["protocol"] for row in rows] == ["thesis", "strict", "off_grid"]
    assert [row["relative"] for row in rows] == pytest.approx([1, 1, 1], rel=1e-3)
    assert all(row["mean_mm"] <= row["rmse_mm"] <= row["max_mm"] for row in rows)


def test_the_time_says_what_it_was_not_spent_on(runner, data, here):
    assert runner.run("a", plain(data, "affine")).taken(12.0) == "12 s"
    outcome = runner.run("a", [*plain(data, "do_nothing", "affine"), *plain(data, "affine")])
    assert outcome.taken(12.0) == "12 s, 2 trials made before"


def test_an_error_keeps_what_is_finished(runner, data, here, monkeypatch):
    good = running.try_and_keep

    def failing(trial, *rest):
        if trial.method == "affine":
            raise InputError("cannot be written (No space left on device)")
        return good(trial, *rest)

    monkeypatch.setattr(running, "try_and_keep", failing)
    with pytest.raises(InputError, match="No space left"):
        runner.run("a", plain(data, "do_nothing", "affine"))
    monkeypatch.setattr(running, "try_and_keep", good)
    here.clear()
    assert runner.run("a", plain(data, "do_nothing", "affine")).left_out == {}
    assert here == ["affine", "affine"]


def test_strict_may_have_fewer_seeds(data):
    asked = taught_twice("gen", "gen", corners(data), data.size, seeds=2, training={"steps": 12})
    each = [(trial.teaching, trial.seed, trial.training["seed"]) for trial in asked]
    assert each == [("off_grid", 0, 0), ("strict", 0, 0), ("off_grid", 1, 1)]


def test_a_training_that_was_gone_on_with_has_no_time(data, store, tmp_path):
    asked = taught_twice("gen", "gen", corners(data), data.size, training={"steps": 12})[0]
    whole, gone_on_with = (run_trial(asked, {"ensemble": store}, tmp_path / "training") for _ in range(2))
    assert whole.told["protocols"] == gone_on_with.told["protocols"]
    assert whole.told["seconds"] > 0
    assert "seconds" not in gone_on_with.told
    outcome = Outcome(data, data.size, [asked, replace(asked, seed=1)], [gone_on_with, whole], {})
    assert outcome.seconds == whole.told["seconds"]
    assert table_rows(outcome)[0]["seconds"] == pytest.approx(whole.told["seconds"], rel=1e-3)


def test_a_missing_package_leaves_a_row_with_its_reason(runner, data, here, monkeypatch):
    def missing(*_):
        raise MissingPackageError("torch-geometric", "train", "the processor 'GCNConv'")

    monkeypatch.setattr("myograph.cli.reproduce.trying.run_trial", missing)
    rows = table_rows(runner.run("a", plain(data, "affine")))
    assert len(rows) == 1
    assert rows[0]["name"] == "affine"
    assert "needs the package 'torch-geometric'" in rows[0]["left_out"]
    monkeypatch.undo()


def test_seeds_become_a_mean_and_a_deviation(runner, data, here):
    trials = taught_twice("affine", "affine", corners(data), data.size, seeds=3, strict_seeds=3)
    outcome = runner.run("a", trials)
    row = table_rows(outcome)[1]
    each = [found.told["protocols"]["strict"]["mean_mm"] for found in outcome.of("affine", "strict")]
    assert row["seeds"] == 3
    assert row["mean_mm"] == pytest.approx(np.mean(each), rel=1e-3)
    assert row["mean_mm_std"] == pytest.approx(np.std(each, ddof=1), rel=1e-3)
    assert row["mean_mm_seeds"] == pytest.approx(each, rel=1e-3)
    largest = [found.told["protocols"]["strict"]["max_mm"] for found in outcome.of("affine", "strict")]
    assert row["max_mm"] == pytest.approx(max(largest), rel=1e-3)
    assert max(largest) > 1.001 * np.mean(largest)


def test_errors_over_the_distance_are_kept_by_unit(data, store):
    fields, thin = ("position", "cauchy_stress"), {"modes": 2, "members": 1, "steps": 20}
    (asked, _) = taught_twice("m", "neural_modes", corners(data), data.size, options=thin, asked=fields)
    found = run_trial(asked, {"ensemble": store})
    for unit, figure in (("mm", "mean_mm"), ("mpa", "von_mises_mean_mpa")):
        distance, error = found.arrays[f"far_{unit}_off_grid"]
        assert error.mean() == pytest.approx(found.told["protocols"]["off_grid"][figure], rel=1e-5)
        assert (distance > 0).all()


def test_sensors_are_other_ones_for_another_seed(data, store):
    grey = []
    for seed in (0, 1):
        (asked, _) = taught_twice("a", "affine", corners(data), data.size)
        found = run_trial(replace(asked, seed=seed), {"ensemble": store})
        grey.append(set(np.flatnonzero(np.isnan(found.arrays["node_mm_off_grid"]))))
    assert len(grey[0]) == len(grey[1]) == 9
    assert grey[0] != grey[1]


def test_drawn_cases_are_not_tested_on_those_that_teach(data):
    asked = Trial("a", "pod_gp", corners(data), "off_grid")
    assert asked.tested == ("thesis", "off_grid")
    assert replace(asked, drawn=Drawn(8, "random")).tested == ("off_grid",)


def test_another_store_can_hold_the_truth(data, store):
    numbers, inside = data.numbers("ensemble", "factorial"), data.numbers("ensemble", "off_grid")
    asked = Trial("a", "affine", Chosen("ensemble", numbers, inside, truth="again"), "off_grid")
    cases = cases_of(asked.cases, {"ensemble": store, "again": store})
    half = len(numbers) + len(inside)
    assert len(cases) == 2 * half
    for protocol in ("thesis", "strict", "off_grid"):
        split = split_of(asked, cases, protocol)
        assert split.train.cases.max() < half <= split.test.min()
    alone = Trial("a", "affine", Chosen("ensemble", numbers, inside), "off_grid")
    same = [run_trial(trial, {"ensemble": store, "again": store}).told["protocols"] for trial in (asked, alone)]
    assert same[0] == same[1]


def test_a_graph_keeps_its_nodes_and_its_curve(data, store):
    trials = taught_twice("gen", "gen", corners(data), data.size, training={"steps": 12})
    found = run_trial(trials[0], {"ensemble": store})
    assert found.arrays["nodes_before"].shape == found.arrays["nodes_after"].shape == (8, 3)
    assert found.arrays["curve"].shape == (2, 12)
    assert set(found.told["protocols"]) == {"thesis", "off_grid"}
    nodes = found.arrays["node_mm_thesis"]
    assert np.isnan(nodes).sum() == 9
    assert np.nanmean(nodes) == pytest.approx(found.told["protocols"]["thesis"]["mean_mm"], rel=1e-5)
    distance, error = found.arrays["far_mm_off_grid"]
    assert (distance > 0).all()
    assert error.mean() == pytest.approx(found.told["protocols"]["off_grid"]["mean_mm"], rel=1e-5)


@pytest.mark.exhaustive
def test_a_weighed_model_says_its_size_and_its_multiplications(data, store):
    options = {"latent": 4, "hidden": (4,)}
    asked = taught_twice("g", "gen", corners(data), data.size, options=options, training={"steps": 3}, weighed=True)
    told = run_trial(asked[0], {"ensemble": store}).told
    assert told["weights_kb"] == pytest.approx(told["stored"] * 4 / 1000, rel=0.05)
    assert told["onnx_kb"] > 0
    assert told["onnx_ms"] > 0
    assert told["multiply_adds"] > 0


def test_trials_that_were_kept_and_are_gone_are_refused(runner, data, monkeypatch):
    monkeypatch.setattr(running, "side_by_side", lambda work, tasks, on_news: [None for _ in tasks])
    with pytest.raises(InputError, match=r"cache: expected the 2 trials that were kept there.* run it again"):
        runner.run("a", plain(data, "affine"))


FIGURES = {"protocols": {}, "seconds": 1.0}


@pytest.fixture
def weighed_without_c(runner, data, monkeypatch):
    """A trial of neural modes in the cache that had no compiler; the list of those that are made anew, with one."""
    (trial, _) = plain(data, "neural_modes")
    trial = replace(trial, weighed=True)
    runner.cache.put(runner.keys([trial])[0], Found(FIGURES))
    made = []

    def one_by_one(work, tasks, on_news):
        for task in tasks:
            made.append(task[0].name)
            runner.cache.put(task[1], Found({**FIGURES, "c_kb": 57.0}))
        return [None for _ in tasks]

    monkeypatch.setattr(running, "side_by_side", one_by_one)
    return trial, made


def test_a_model_that_was_weighed_without_a_compiler_is_weighed_anew_where_there_is_one(
    runner, weighed_without_c, monkeypatch
):
    trial, made = weighed_without_c
    monkeypatch.setattr(weighing.shutil, "which", lambda _: None)
    assert runner.run("a", [trial]).found[0].told == FIGURES
    assert finished([trial], [{"name": trial.name}])
    monkeypatch.setattr(weighing.shutil, "which", lambda _: "cc")
    assert not finished([trial], [{"name": trial.name}])
    for _ in range(2):
        assert runner.run("a", [trial]).found[0].told["c_kb"] == 57.0
    assert made == ["neural_modes"]
    assert finished([trial], [{"name": trial.name, "c_kb": 57.0}])


def test_a_section_with_a_row_that_was_left_out_is_not_finished(data):
    trials = plain(data, "affine", "do_nothing")
    rows = [{"name": "affine", "protocol": "strict"}, {"name": "do_nothing", "left_out": "no package"}]
    assert not finished(trials, rows)
    assert finished(trials, rows[:1])
