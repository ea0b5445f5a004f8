"""Runs: same bytes whoever computes, failures as rows, retries, limits, resuming, refusals."""

import os
import subprocess
import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="runs need Dask")

import psutil
from distributed import LocalCluster

from myograph.ensemble.running.cluster import SlurmConfig, slurm_cluster
from myograph.ensemble.running.run import Listener, RunOptions, run_store
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.opening import open_muscle, reasons
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import read_row, row_path
from myograph.errors import InputError
from tests.ensemble import synthetic

ROOT = Path(__file__).parents[3]


@pytest.fixture(autouse=True)
def _at_the_root(monkeypatch):
    monkeypatch.chdir(ROOT)


def number_of(store, case):
    return round(1000 * read_plan(store).design.cases[case].activations[0])


@pytest.mark.parametrize("kind", [synthetic.FACTORY, synthetic.REMEMBERING])
def test_one_worker_two_workers_and_a_run_in_two_parts_make_the_same_bytes(make, kind):
    one, two, parts = (make(name, count=40, kind=kind) for name in ("one", "two", "parts"))
    told = []
    result = run_store(one, RunOptions(workers=1), Listener(told.append))
    assert (result["cases"], result["done"], result["failed"], result["store"]) == (40, 40, 0, str(one))
    assert told[-1] == 40
    assert told == sorted(told)
    run_store(two, RunOptions(workers=2))
    for source in sorted((one / "rows").iterdir())[::3]:
        (parts / "rows" / source.name).write_bytes(source.read_bytes())
    for source in (one / "biceps").rglob("c.*"):
        (parts / source.relative_to(one)).write_bytes(source.read_bytes())
    run_store(parts, RunOptions(workers=2))
    assert store_checksum(one) == store_checksum(two) == store_checksum(parts)
    assert not list(check_store(parts, read_plan(parts)))


def test_a_simulator_that_fails_crashes_dies_or_hangs_leaves_failed_rows_and_the_others_go_on(make):
    store = make(count=25, preset="fail=0 crash=100 die=500 hang=1000")
    result = run_store(store, RunOptions(workers=2, seconds=1.0, retries=1))
    expected = {
        0: "no way further",
        100: "ZeroDivisionError: a bug",
        500: "its process died 2 times",
        1000: "took longer than 1 s",
    }
    failed = {case: expected[number] for case in range(25) if (number := number_of(store, case)) in expected}
    assert reasons(store) == failed
    assert set(failed.values()) == set(expected.values())
    assert (result["done"], result["failed"]) == (21, 4)
    case = next(case for case, reason in failed.items() if reason == "no way further")
    assert read_row(store, case).residuals == (3.0, 2.0, 2.5)
    assert open_muscle(store, "biceps")["state"].values.tolist().count("failed") == len(failed)
    assert not list(check_store(store, read_plan(store)))


def test_running_again_asks_only_for_what_is_missing(make, tmp_path):
    store = make(count=30, preset=f"asked={tmp_path / 'asked'}")
    run_store(store, RunOptions(workers=1))
    (tmp_path / "asked").unlink()
    run_store(store, RunOptions(workers=1))
    assert not (tmp_path / "asked").exists()
    row_path(store, 7).unlink()
    run_store(store, RunOptions(workers=1))
    assert (tmp_path / "asked").read_text() == f"{number_of(store, 7)}\n"


@pytest.mark.exhaustive
def test_a_lost_dask_worker_is_replaced_and_its_cases_are_not_lost(make):
    """Real worker processes behind a scheduler's address; one is killed while it works."""
    store, peaceful = (make(name, count=60, preset="sleep=0.03") for name in ("store", "peaceful"))
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50) as cluster:
        options = RunOptions(scheduler=cluster.scheduler_address)
        work = threading.Thread(target=run_store, args=(store, options))
        work.start()
        while len(list((store / "rows").iterdir())) < 5:
            time.sleep(0.01)
        psutil.Process(next(iter(cluster.workers.values())).pid).kill()
        work.join(60)
        assert not work.is_alive()
    run_store(peaceful, RunOptions(workers=1))
    assert store_checksum(store) == store_checksum(peaceful)


def test_a_second_runner_is_refused(make):
    store = make()
    with locked(store, 0), pytest.raises(InputError, match="is at work on it"):
        run_store(store, RunOptions(workers=1))


def test_a_simulator_that_cannot_be_made_stops_the_run_and_says_why(make):
    store = make(count=5)
    os.environ["SYNTHETIC_BROKEN"] = "1"
    try:
        with pytest.raises(InputError, match=r"the simulator cannot be made: .*RuntimeError: broken"):
            run_store(store, RunOptions(workers=1))
    finally:
        del os.environ["SYNTHETIC_BROKEN"]
    assert not list((store / "rows").iterdir())


def test_a_full_disk_stops_the_run_says_so_and_nothing_is_half_written(make, tmp_path):
    place = tmp_path / "small"
    place.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=700k", "tmpfs", place], capture_output=True).returncode:
        pytest.skip("no small file system can be mounted here")
    try:
        store = make("small/store", count=200)
        with pytest.raises(InputError, match="No space left on device"):
            run_store(store, RunOptions(workers=2))
        done = len(list((store / "rows").iterdir()))
        assert 0 < done < 200
        with (place / "rest").open("wb", buffering=0) as rest, suppress(OSError):
            while True:
                rest.write(bytes(4096))
        with pytest.raises(InputError, match="No space left on device"):
            run_store(store, RunOptions(workers=2))
        (place / "rest").unlink()
        subprocess.run(["mount", "-o", "remount,size=8m", place], check=True)
        assert run_store(store, RunOptions(workers=2))["done"] == 200
        assert not list(check_store(store, read_plan(store)))
    finally:
        subprocess.run(["umount", place], check=False)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"workers": 0}, "workers: expected at least 1"),
        ({"seconds": 0.0}, "time limit: expected a positive"),
        ({"seconds": float("nan")}, "time limit: expected a positive"),
        ({"seconds": float("inf")}, "time limit: expected a positive"),
        ({"seconds": 1e30}, "time limit: expected a positive"),
        ({"retries": -1}, "retries: expected at least 0"),
    ],
)
def test_options_that_make_no_run_are_refused(options, words):
    with pytest.raises(InputError, match=words):
        RunOptions(**options)


def test_a_scheduler_that_is_not_there_or_two_places_to_run_are_refused(make, tmp_path):
    store = make(count=2)
    with pytest.raises(InputError, match="expected either a scheduler's address or a SLURM"):
        run_store(store, RunOptions(scheduler="tcp://127.0.0.1:1", slurm=tmp_path))
    with pytest.raises(InputError, match=r"scheduler tcp://127.0.0.1:1: does not answer"):
        run_store(store, RunOptions(scheduler="tcp://127.0.0.1:1"))


@pytest.mark.parametrize(
    ("given", "word"), [({"memory": "4 lots"}, "memory 4 lots"), ({"interface": "eth77"}, "eth77")]
)
def test_memory_or_an_interface_that_there_cannot_be_is_refused(given, word):
    pytest.importorskip("dask_jobqueue.slurm")
    with pytest.raises(InputError, match=f"SLURM: expected memory such as '4 GB' and a known interface, got .*{word}"):
        slurm_cluster(SlurmConfig(jobs=1, **given))


def test_a_slurm_configuration_becomes_the_script_of_a_job(monkeypatch):
    jobqueue = pytest.importorskip("dask_jobqueue.slurm")
    monkeypatch.setattr(jobqueue.SLURMCluster, "scale", lambda self, jobs: None)
    config = SlurmConfig(
        jobs=4, cores=8, memory="16 GB", walltime="02:00:00", queue="long", directives=("--exclusive",)
    )
    with slurm_cluster(config) as cluster:
        script = cluster.job_script()
    assert all(f"#SBATCH {line}" in script for line in ("-p long", "--cpus-per-task=8", "-t 02:00:00", "--exclusive"))
    assert "--nthreads 1" in script
    assert "--nworkers 8" in script
