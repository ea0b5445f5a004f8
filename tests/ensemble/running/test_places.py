"""Workers that come late, schedulers that are lost, and what a killed run leaves on its scheduler."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

pytest.importorskip("distributed", reason="runs need Dask")

from distributed import LocalCluster

from myograph.ensemble.running import drive
from myograph.ensemble.running.cluster import SlurmJobs
from myograph.ensemble.running.listener import Listener
from myograph.ensemble.running.run import RunOptions, run_store
from myograph.ensemble.store.rows import states
from myograph.errors import InputError

ROOT = Path(__file__).parents[3]
RUN = """
import sys
from pathlib import Path
from myograph.ensemble.running.run import RunOptions, run_store
run_store(Path(sys.argv[1]), RunOptions(scheduler=sys.argv[2]))
"""
SBATCH = """#!/bin/sh
echo submitted >> {place}/said
cp "$1" {place}/job.sh
(sleep 3; exec sh {place}/job.sh) > {place}/log 2>&1 &
echo "Submitted batch job 7"
"""


@pytest.fixture(autouse=True)
def _at_the_root(monkeypatch):
    monkeypatch.chdir(ROOT)


def cluster_of(workers, **options):
    """A scheduler in this process, reached by an address of its own."""
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=False,
        protocol="tcp",
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        worker_dashboard_address=None,
        silence_logs=50,
        **options,
    )


class Work(threading.Thread):
    """A run in a thread of its own; `result` is what came of it."""

    def __init__(self, store, options, listener=None):
        super().__init__(daemon=True)
        self.arguments, self.result = (store, options, *([listener] if listener else [])), None
        self.start()

    def run(self):
        try:
            self.result = run_store(*self.arguments)
        except Exception as problem:
            self.result = problem

    def ended(self):
        self.join(90)
        assert not self.is_alive()
        return self.result


def wait_for_rows(store, count):
    while len(list((store / "rows").iterdir())) < count:
        time.sleep(0.01)


def test_a_run_waits_for_the_first_worker_of_a_scheduler_and_says_so(make, monkeypatch):
    monkeypatch.setattr(drive, "_PATIENCE", 0.3)
    store, threads = make(count=5), []
    with cluster_of(0) as cluster:
        work = Work(store, RunOptions(scheduler=cluster.scheduler_address), Listener(threads=threads.append))
        time.sleep(4)
        assert work.is_alive()
        cluster.scale(1)
        assert work.ended()["done"] == 5
    assert (threads[0], threads[-1]) == (0, 1)


def test_without_any_worker_after_the_first_a_run_ends_and_says_so(make, monkeypatch):
    monkeypatch.setattr(drive, "_PATIENCE", 0.3)
    store = make(count=60, preset="sleep=0.1")
    with cluster_of(1) as cluster:
        work = Work(store, RunOptions(scheduler=cluster.scheduler_address))
        wait_for_rows(store, 3)
        cluster.scale(0)
        problem = work.ended()
    assert isinstance(problem, InputError)
    assert "stopped 3 times: no worker was there for 0.3 s; see to the workers and run it again" in str(problem)


def test_a_lost_scheduler_is_one_line(make):
    store = make(count=200, preset="sleep=0.05")
    with cluster_of(1) as cluster:
        work = Work(store, RunOptions(scheduler=cluster.scheduler_address))
        wait_for_rows(store, 3)
    problem = work.ended()
    assert isinstance(problem, InputError)
    assert "does not answer" in str(problem)
    assert "failed" not in states(store, 200)


def test_a_scheduler_that_is_started_again_is_gone_on_with(make):
    store = make(count=60, preset="sleep=0.05")
    with cluster_of(1) as cluster:
        address = cluster.scheduler_address
        work = Work(store, RunOptions(scheduler=address))
        wait_for_rows(store, 3)
    with cluster_of(1, scheduler_port=int(address.rsplit(":", 1)[1])):
        result = work.ended()
    assert result["done"] == 60


@pytest.mark.slow
def test_a_run_ends_what_a_killed_run_of_the_same_store_left_on_the_scheduler(make):
    store = make(count=40, preset="sleep=0.1")
    with cluster_of(1) as cluster:
        command = [sys.executable, "-c", RUN, str(store), cluster.scheduler_address]
        killed = subprocess.Popen(command, cwd=ROOT)
        wait_for_rows(store, 3)
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        assert run_store(store, RunOptions(scheduler=cluster.scheduler_address))["done"] == 40
        left = [name for worker in cluster.workers.values() for name in worker.plugins if name.startswith("myograph")]
    assert not left


def jobs(**named):
    return {name: SimpleNamespace(job_id=number) for name, number in named.items()}


def test_jobs_stand_in_the_queue_until_a_worker_of_theirs_was_seen():
    cluster = SimpleNamespace(workers=jobs(a="1", b="2", c=None), scheduler_info={"workers": {}})
    queue = SlurmJobs(cluster)
    assert queue.queued()
    cluster.scheduler_info["workers"] = {"tcp://1": {"name": "a-0"}, "tcp://2": {"name": "a-1"}}
    assert queue.queued()
    cluster.scheduler_info["workers"] = {"tcp://3": {"name": "b"}}
    assert not queue.queued()
    cluster.scheduler_info["workers"] = {}
    assert not queue.queued()


def test_a_job_that_could_not_be_submitted_is_not_waited_for():
    assert not SlurmJobs(SimpleNamespace(workers=jobs(a=None), scheduler_info={"workers": {}})).queued()


@pytest.mark.slow
def test_a_job_that_waits_in_the_queue_longer_than_patience_is_submitted_once(make, tmp_path, monkeypatch):
    """The real cluster of dask-jobqueue, with an `sbatch` that lets its job wait."""
    pytest.importorskip("dask_jobqueue")
    monkeypatch.setattr(drive, "_PATIENCE", 0.5)
    (tmp_path / "sbatch").write_text(SBATCH.format(place=tmp_path))
    (tmp_path / "scancel").write_text("#!/bin/sh\n")
    for name in ("sbatch", "scancel"):
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    (tmp_path / "slurm.toml").write_text('jobs = 1\nmemory = "1 GB"\n')
    store = make(count=5)
    assert Work(store, RunOptions(slurm=tmp_path / "slurm.toml")).ended()["done"] == 5
    assert (tmp_path / "said").read_text() == "submitted\n"
