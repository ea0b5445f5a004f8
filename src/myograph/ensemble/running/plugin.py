"""What a Dask worker keeps between batches: for each of its threads a solver with the simulator's process.

A runner that is killed leaves its plugin on a scheduler of its own; the next run of the same store ends it first.
"""

import threading
import uuid
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any

from distributed import Client, WorkerPlugin, get_worker

from myograph.ensemble.running.batch import BatchSolver, SolverEndedError, Task
from myograph.ensemble.running.lost import reaching
from myograph.ensemble.store.checksum import checksum


class SolverPlugin(WorkerPlugin):
    """Makes a thread's solver when its first batch comes; ends all of them with the run."""

    def __init__(self, task: Task, name: str) -> None:
        self.task, self.name = task, name

    def setup(self, worker: Any) -> None:
        """Start with no solver."""
        self._own = threading.local()
        self._all: list[BatchSolver] = []
        self._ended = False

    def teardown(self, worker: Any) -> None:
        """End the simulators' processes, and what works on batches now."""
        self._ended = True
        for solver in self._all:
            solver.end()

    def solve(self, batch: Sequence[int]) -> str:
        """See `BatchSolver.solve`."""
        if not hasattr(self._own, "solver"):
            self._own.solver = BatchSolver(self.task)
            self._all.append(self._own.solver)
        if self._ended:
            raise SolverEndedError
        return self._own.solver.solve(batch)

    def __getstate__(self) -> dict[str, Any]:
        """Only what makes it; solvers stay where they are."""
        return {"task": self.task, "name": self.name}


@contextmanager
def solvers(client: Client, task: Task) -> Iterator[str]:
    """Plugins on all workers while a run lasts, by their name; those of a killed run of the same store end before.

    Raises SchedulerLostError where the scheduler does not answer.
    """
    store = f"myograph-{checksum(task.store.encode())}"
    name = f"{store}-{uuid.uuid4().hex}"
    with reaching(client):
        left: Any = client.get_metadata([store], None)
        if left:
            _end(client, left)
        client.set_metadata([store], name)
        client.register_plugin(SolverPlugin(task, name), name=name)
    try:
        yield name
    finally:
        _end(client, name)


def _end(client: Client, name: str) -> None:
    """End a plugin on all workers; with a scheduler that is gone it has gone, too."""
    if client.status == "running":
        with suppress(Exception):
            client.unregister_worker_plugin(name)


def solve_batch(name: str, batch: tuple[int, ...]) -> str:
    """The task of one batch, run on a worker that has the plugin of this name."""
    plugin = get_worker().plugins.get(name)
    if not isinstance(plugin, SolverPlugin):
        raise SolverEndedError
    return plugin.solve(batch)
