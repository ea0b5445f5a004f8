"""What a Dask worker keeps between batches: for each of its threads a solver with the simulator's process."""

import threading
from collections.abc import Sequence
from typing import Any

from distributed import WorkerPlugin, get_worker

from myograph.ensemble.running.batch import BatchSolver, Task


class SolverPlugin(WorkerPlugin):
    """Makes a thread's solver when its first batch comes; ends all of them with the run."""

    def __init__(self, task: Task, name: str) -> None:
        self.task, self.name = task, name

    def setup(self, worker: Any) -> None:
        """Start with no solver."""
        self._own = threading.local()
        self._all: list[BatchSolver] = []

    def teardown(self, worker: Any) -> None:
        """End the simulators' processes."""
        for solver in self._all:
            solver.end()

    def solve(self, batch: Sequence[int]) -> str:
        """See `BatchSolver.solve`."""
        if not hasattr(self._own, "solver"):
            self._own.solver = BatchSolver(self.task)
            self._all.append(self._own.solver)
        return self._own.solver.solve(batch)

    def __getstate__(self) -> dict[str, Any]:
        """Only what makes it; solvers stay where they are."""
        return {"task": self.task, "name": self.name}


def solve_batch(name: str, batch: tuple[int, ...]) -> str:
    """The task of one batch, run on a worker that has the plugin of this name."""
    plugin = get_worker().plugins[name]
    assert isinstance(plugin, SolverPlugin)
    return plugin.solve(batch)
