"""Where batches run: a local cluster, a scheduler that runs already, or jobs of SLURM.

Local workers are threads of this process: they only wait for the simulators, which have processes of their own.
"""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
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


@contextmanager
def connected(workers: int, scheduler: str | None = None, slurm: Path | None = None) -> Iterator[Client]:
    """A client of the scheduler at an address, of jobs of SLURM, or else of so many local workers.

    Raises InputError where the scheduler does not answer.
    """
    if scheduler is not None and slurm is not None:
        raise InputError("expected either a scheduler's address or a SLURM configuration, got both")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with config.set(_SETTINGS):
        if scheduler is not None:
            with _reached(scheduler) as client:
                yield client
            return
        cluster = slurm_cluster(read_toml(slurm, SlurmConfig)) if slurm is not None else _local(workers)
        with cluster, Client(cluster) as client:
            yield client


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
    """The cluster, its jobs submitted; raises MissingPackageError without dask-jobqueue."""
    try:
        from dask_jobqueue.slurm import SLURMCluster
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "cluster", "running on SLURM") from None
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
    cluster.scale(jobs=asked.jobs)
    return cluster


def _reached(address: str) -> Client:
    try:
        return Client(address, timeout=5)
    except (OSError, ValueError, TimeoutError) as problem:
        raise InputError(f"scheduler {address}: does not answer ({problem}); start one with 'dask scheduler'") from None
