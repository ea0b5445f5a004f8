"""The comparison with peers: what adapters are given, how they are judged, what becomes of one that fails."""

import json
import shutil
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.ensemble.pairs.made_up import made_up

from myograph.errors import InputError

PEERS = Path(__file__).parents[2] / "benchmarks" / "peers"
MODULES = ("compare", "export_cases", "run_peer", "ours", "page", "sources")


@pytest.fixture
def peers(monkeypatch):
    """The folder's modules, importable as they are when it is run as a script."""
    monkeypatch.syspath_prepend(str(PEERS))
    import compare
    import export_cases
    import ours
    import page
    import run_peer
    import sources

    yield {
        "compare": compare,
        "export": export_cases,
        "run": run_peer,
        "ours": ours,
        "page": page,
        "sources": sources,
    }
    for name in [name for name in sys.modules if name in MODULES or name.split(".")[0] == "adapters"]:
        sys.modules.pop(name)


@pytest.fixture
def arrays(peers):
    return peers["export"].arrays_of(made_up(factorial=10, off_grid=4, support=6), seed=0)


def test_what_tests_does_not_teach_but_under_thesis(arrays):
    for protocol in ("strict", "off_grid"):
        assert not set(arrays[f"train_{protocol}"]) & set(arrays[f"test_{protocol}"])
        assert len(arrays[f"test_{protocol}"]) > 0
    assert set(arrays["test_thesis"]) <= set(arrays["train_thesis"])


def test_a_right_answer_has_no_error_and_sensors_do_not_count(peers, arrays):
    tested = arrays["test_strict"]
    right = {name: arrays[name][tested].copy() for name in ("position", "von_mises")}
    right["position"][:, arrays["sensors"]] += 100.0
    found = peers["run"].errors(right, arrays, tested)
    assert found == {"mean_mm": 0.0, "p95_mm": 0.0, "max_mm": 0.0, "von_mises_mean_mpa": 0.0}
    right["position"] += np.array([3.0, 4.0, 0.0])
    assert peers["run"].errors(right, arrays, tested)["mean_mm"] == pytest.approx(5.0)


@pytest.mark.filterwarnings("ignore::sklearn.exceptions.ConvergenceWarning")
def test_an_adapter_answers_in_the_common_shape(peers, arrays, tmp_path):
    np.savez(tmp_path / "cases.npz", **arrays)
    told = peers["run"].run("sklearn_pod", tmp_path / "cases.npz", "off_grid", 1.0, 0)
    assert "reason" not in told, told
    assert 0 < told["mean_mm"] <= told["p95_mm"] <= told["max_mm"]
    assert told["numbers"] > 0


@pytest.mark.parametrize(
    ("adapter", "reason"), [("not_there", "cannot be imported"), ("broken_here", "ValueError: no")]
)
def test_an_adapter_that_cannot_do_it_says_why(peers, arrays, tmp_path, monkeypatch, adapter, reason):
    def fit(task):
        raise ValueError("no\nway")

    monkeypatch.setitem(sys.modules, "adapters.broken_here", SimpleNamespace(fit=fit, DOES={}))
    np.savez(tmp_path / "cases.npz", **arrays)
    assert peers["run"].run(adapter, tmp_path / "cases.npz", "strict", 1.0, 0)["reason"].startswith(reason)


def test_peers_without_their_environment_keep_their_rows(peers, tmp_path):
    asked = SimpleNamespace(python=tmp_path / "nowhere" / "python", seconds=1.0)
    told = peers["compare"].peer("ezyrb_pod_rbf", tmp_path / "cases.npz", "strict", asked, 0)
    assert "no environment of the peers" in told["reason"]
    lines = peers["page"].table([{"name": "ezyrb_pod_rbf", "protocol": "strict", **told}]).splitlines()
    assert "not measured: no environment" in lines[-1]


def test_every_adapter_is_short():
    for path in (PEERS / "adapters").glob("*.py"):
        assert len(path.read_text().splitlines()) < 100, path


def test_the_kept_table_has_every_method(peers):
    told = json.loads((PEERS / "peers.json").read_text())
    names = {row["name"] for row in told["rows"]}
    assert names == set(peers["compare"].NAMES)
    assert (PEERS / "peers.md").read_text() == peers["page"].page(told)


def test_no_kept_row_that_is_trained_by_steps_took_more_than_the_limit(peers):
    told = json.loads((PEERS / "peers.json").read_text())
    stepped = [row for row in told["rows"] if row.get("steps") is not None]
    assert {row["name"] for row in stepped} >= {"feed_forward", "deeponet", "gen_thesis_8"}
    for row in stepped:
        assert row["train_s"] <= 1.05 * told["seconds"], row["name"]


def test_knowing_nothing_answers_the_mean_of_what_teaches(peers, arrays, tmp_path):
    np.savez(tmp_path / "cases.npz", **arrays)
    told = peers["run"].run("mean_shape", tmp_path / "cases.npz", "off_grid", 1.0, 0)
    tested, taught = arrays["test_off_grid"], arrays["train_off_grid"]
    mean = {name: arrays[name][taught].mean(axis=0)[None] for name in ("position", "von_mises")}
    right = peers["run"].errors(mean, arrays, tested)
    assert {name: told[name] for name in right} == pytest.approx(right)
    assert told["steps"] is None


def test_seeds_become_a_mean_and_a_sample_deviation_and_one_that_failed_is_told(peers):
    measured = [{"mean_mm": 1.0, "reads": "sensors"}, {"reason": "no way"}, {"mean_mm": 3.0, "reads": "sensors"}]
    found = peers["compare"].mean_of(measured)
    assert found.pop("mean_mm_std") == pytest.approx(np.sqrt(2))
    assert found == {"mean_mm": 2.0, "reads": "sensors", "answered": 2, "asked": 3, "failed": ["no way"]}
    line = peers["page"].table([{"name": "a", "protocol": "strict", **found, "mean_mm_std": 1.0}]).splitlines()[-1]
    assert line.startswith("| a (2 of 3 seeds) | strict | 2 ± 1 |")
    assert peers["compare"].mean_of([{"reason": "no way"}] * 2) == {"reason": "no way"}


@pytest.mark.parametrize(
    ("value", "shown"), [(1234.5, "1,234"), (999.7, "1,000"), (999.4, "999"), (0.01234, "0.0123"), (7, "7")]
)
def test_thousands_are_whole_numbers(peers, value, shown):
    row = {"name": "a", "protocol": "strict", "steps": value}
    assert f"| {shown} |" in peers["page"].table([row])


def test_a_reason_with_a_bar_stays_one_cell(peers):
    line = peers["page"].table([{"name": "a", "protocol": "strict", "reason": "int | None"}]).splitlines()[-1]
    assert line == r"| a | strict | not measured: int \| None |"


ABOUT = {"seconds": 1.0, "seeds": 1, "data": "x"}


def test_rows_of_another_run_are_kept_and_those_of_no_method_are_not(peers, tmp_path):
    rows = [{"name": name, "protocol": "strict", "mean_mm": 1.0} for name in ("pod_gp", "taken_away")]
    out = tmp_path / "peers.json"
    peers["compare"].write(out, {**ABOUT, "load": 1.0, "rows": rows})
    assert peers["compare"].kept(out, ABOUT) == {("pod_gp", "strict"): rows[0]}
    assert peers["compare"].in_order({(row["name"], "strict"): row for row in rows}) == rows[:1]
    assert "| pod_gp | strict | 1 |" in (tmp_path / "peers.md").read_text()
    assert peers["compare"].kept(tmp_path / "nothing.json", ABOUT) == {}


def test_rows_of_other_cases_are_not_written_over(peers, tmp_path):
    out = tmp_path / "peers.json"
    peers["compare"].write(out, {**ABOUT, "load": 1.0, "rows": []})
    with pytest.raises(InputError, match="expected rows of data y, got x; name another --out"):
        peers["compare"].kept(out, {**ABOUT, "data": "y"})


def test_a_store_that_is_not_there_ends_with_one_line(peers, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["compare.py", str(tmp_path / "nowhere")])
    monkeypatch.setattr(peers["compare"], "threadpool_limits", lambda count: None)
    monkeypatch.setattr(peers["compare"].torch, "set_num_threads", lambda count: None)
    with pytest.raises(SystemExit, match=r"compare\.py: .*nowhere"):
        peers["compare"].main()


def test_a_kept_row_is_due_again_when_its_code_has_changed(peers):
    code = peers["compare"].code_of("pod_gp")
    rows = {("pod_gp", "strict"): {"code": code}, ("sklearn_pod", "strict"): {"code": "other"}}
    due = peers["compare"].due(rows, ("mean_shape",), ("off_grid",))
    assert due == [("mean_shape", "off_grid"), ("sklearn_pod", "strict")]


@pytest.mark.parametrize(
    ("method", "file"),
    [
        ("ezyrb_pod_gpr", "adapters/ezyrb_pod_gpr.py"),
        ("ezyrb_pod_gpr", "adapters/sklearn_pod.py"),
        ("ezyrb_pod_gpr", "run_peer.py"),
        ("pod_gp", "ours.py"),
    ],
)
def test_code_is_all_that_a_row_hangs_on(peers, tmp_path, monkeypatch, method, file):
    copy = tmp_path / "peers"
    shutil.copytree(PEERS, copy)
    monkeypatch.setattr(peers["sources"], "HERE", copy)
    before = [peers["compare"].code_of(name) for name in (method, "ezyrb_pod_rbf")]
    (copy / "adapters" / "stepwise.py").write_text("other")
    assert [peers["compare"].code_of(name) for name in (method, "ezyrb_pod_rbf")] == before
    (copy / file).write_text("other")
    assert peers["compare"].code_of(method) != before[0]


def test_every_seed_is_tested_on_cases_off_the_grid_of_its_own(peers, tmp_path, monkeypatch):
    monkeypatch.setattr(peers["export"], "TESTED", 3)
    store = made_up(factorial=10, off_grid=7, support=6)
    monkeypatch.setattr(peers["export"], "read_muscle", lambda path, muscle: store)
    cases = peers["export"].cases_of(tmp_path, 4, 2)
    assert [cases.design.count(word) for word in ("factorial", "support", "off_grid")] == [10, 4, 6]
    for seed in range(2):
        arrays = peers["export"].arrays_of(peers["export"].of_seed(cases, seed), seed)
        assert np.array_equal(arrays["activation"][arrays["test_off_grid"]], store.activation[3 * seed : 3 * seed + 3])
        assert len(arrays["train_off_grid"]) == 14
    with pytest.raises(InputError, match="at least 9 cases of design 'off_grid', 3 for each of 3 seeds, got 7"):
        peers["export"].cases_of(tmp_path, 4, 3)


class Clock:
    """A processor's clock that moves when it is told to, and by `tick` whenever it is read."""

    def __init__(self, tick=0.0):
        self.now, self.tick = 100.0, tick

    def __call__(self):
        self.now += self.tick
        return self.now


def test_a_peer_takes_no_step_that_would_not_fit(peers, monkeypatch):
    import torch
    from adapters import stepwise

    clock = Clock()
    monkeypatch.setattr(time, "process_time", clock)
    module = torch.nn.Linear(5, 8)
    taken = []

    def forward(activation):
        clock.now += 3.0
        taken.append(clock.now)
        return module(activation).view(-1, 2, 4)

    draw = np.random.default_rng(0)
    task = SimpleNamespace(
        position=draw.normal(size=(6, 2, 3)), von_mises=draw.normal(size=(6, 2)), activation=draw.uniform(size=(6, 5)),
        seconds=10.0, started=clock.now, seed=0,
    )  # fmt: skip
    trained = stepwise.train(module, forward, task)
    assert taken == [103.0, 106.0, 109.0]
    assert trained.steps == 3


@pytest.mark.parametrize("name", ["feed_forward", "deeponet", "gen_thesis_8"])
def test_a_training_of_ours_ends_by_the_processors_clock(peers, monkeypatch, name):
    monkeypatch.setattr(time, "process_time", Clock(tick=0.01))
    told = peers["ours"].ours(name, made_up(factorial=10, off_grid=4, support=6), "off_grid", 1.0, 0)
    assert 0.95 <= told["train_s"] <= 1.05
    assert 40 <= told["steps"] <= 50


def test_a_method_of_ours_without_steps_has_none(peers):
    told = peers["ours"].ours("pod_gp", made_up(factorial=10, off_grid=4, support=6), "off_grid", 1.0, 0)
    assert told["steps"] is None
    assert told["mean_mm"] > 0


def test_means_over_neighbours_at_once_are_those_of_a_loop(peers, monkeypatch):
    import torch

    for module in ("neuralop", "neuralop.layers", "neuralop.models"):
        found = SimpleNamespace(integral_transform=SimpleNamespace(), GINO=None)
        monkeypatch.setitem(sys.modules, module, found)
    from adapters.neuralop_gino import segment_csr

    src, ends = torch.randn(2, 7, 3), torch.tensor([[0, 3, 3, 7]]).repeat(2, 1)
    total = segment_csr(src, ends, "sum", use_scatter=False)
    mean = segment_csr(src, ends, "mean", use_scatter=False)
    torch.testing.assert_close(total, torch.stack([src[:, :3].sum(1), torch.zeros(2, 3), src[:, 3:].sum(1)], dim=1))
    torch.testing.assert_close(mean, torch.stack([src[:, :3].mean(1), torch.zeros(2, 3), src[:, 3:].mean(1)], dim=1))
