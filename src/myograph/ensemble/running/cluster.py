"""Where batches run: a local cluster, a scheduler that runs already, or jobs of SLURM.

Local workers are threads of this process: they only wait for the simulators, which have processes of their own. Those
of a scheduler may be started later than the run, and jobs of SLURM may stand in its queue for days: the run waits.
"""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dask import config
from distributed import Client, LocalCluster
from pydantic import Field

from myograph.config import Model, read_toml
from myograph.errors import InputError, MissingPackageError

_SETTINGS = {
    "distributed.scheduler.allowed-failures": 10,
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": False,
}


class SlurmConfig(Model):
    """Jobs of SLURM, one worker of one thread for each core; see dask_jobqueue.SLURMCluster."""

    jobs: int = Field(ge=1)
    cores: int = Field(default=1, ge=1)
    memory: str = "4 GB"
    walltime: str = "04:00:00"
    queue: str | None = None
    account: str | None = None
    interface: str | None = None
    directives: tuple[str, ...] = ()
    prologue: tuple[str, ...] = ()


@dataclass(frozen=True)
class Workplace:
    """Where cases are computed.

    Parameters
    ----------
    client
        Of the scheduler.
    expected
        Whether workers will come that were not there yet, told whether any was there.
    """

    client: Client
    expected: Callable[[bool], bool]


@contextmanager
def connected(workers: int, scheduler: str | None = None, slurm: Path | None = None) -> Iterator[Workplace]:
    """The scheduler at an address, jobs of SLURM, or else so many local workers.

    Raises InputError where the scheduler does not answer, and where SLURM's configuration is wrong.
    """
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with config.set(_SETTINGS):
        if scheduler is not None:
            with _reached(scheduler) as client:
                yield Workplace(client, lambda seen: not seen)
        elif slurm is not None:
            with slurm_cluster(read_slurm(slurm)) as cluster, Client(cluster) as client:
                jobs = SlurmJobs(cluster)
                yield Workplace(client, lambda _: jobs.queued())
        else:
            with _local(workers) as cluster, Client(cluster) as client:
                yield Workplace(client, lambda _: False)


def read_slurm(path: Path) -> SlurmConfig:
    """The configuration of a file; raises InputError with file and key."""
    return read_toml(path, SlurmConfig)


def _local(workers: int) -> LocalCluster:
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=False,
        dashboard_address="127.0.0.1:0",
        worker_dashboard_address=None,
        silence_logs=logging.CRITICAL,
    )


def slurm_cluster(asked: SlurmConfig) -> Any:
    """The cluster, its jobs submitted.

    Raises InputError for memory or a network interface that there cannot be, MissingPackageError without dask-jobqueue.
    """
    try:
        from dask_jobqueue.slurm import SLURMCluster
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "cluster", "running on SLURM") from None
    try:
        cluster = SLURMCluster(
            cores=asked.cores,
            processes=asked.cores,
            memory=asked.memory,
            walltime=asked.walltime,
            queue=asked.queue,
            account=asked.account,
            interface=asked.interface,
            job_extra_directives=list(asked.directives),
            job_script_prologue=list(asked.prologue),
        )
    except (ValueError, RuntimeError, OSError) as problem:
        given = f"memory {asked.memory}, interface {asked.interface or 'not given'}"
        raise InputError(
            f"SLURM: expected memory such as '4 GB' and a known interface, got {given}: {problem}"
        ) from None
    cluster.scale(jobs=asked.jobs)
    return cluster


class SlurmJobs:
    """Which jobs of a cluster still stand in SLURM's queue: those submitted of which no worker was ever seen."""

    def __init__(self, cluster: Any) -> None:
        self._cluster = cluster
        self._begun: set[str] = set()

    def queued(self) -> bool:
        """Whether there are any; to be asked again and again, for it learns from the workers that are there now."""
        names = [str(worker["name"]) for worker in list(self._cluster.scheduler_info["workers"].values())]
        jobs = dict(self._cluster.workers)
        self._begun |= {job for job in jobs if any(name == job or name.startswith(f"{job}-") for name in names)}
        return any(job.job_id is not None for name, job in jobs.items() if name not in self._begun)


def _reached(address: str) -> Client:
    try:
        return Client(address, timeout=5)
    except (OSError, ValueError, TimeoutError) as problem:
        raise InputError(f"scheduler {address}: does not answer ({problem}); start one with 'dask scheduler'") from None
