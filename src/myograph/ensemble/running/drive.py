"""The loop of a run: batches go out as workers are free, what comes back is counted.

Never more than three batches a thread are out, so that neither the scheduler nor this process grows with the number of
cases.
"""

import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from distributed import Future, KilledWorker, wait

from myograph.ensemble.running.batch import SolverEndedError
from myograph.ensemble.running.cluster import Workplace
from myograph.ensemble.running.listener import Listener
from myograph.ensemble.running.lost import NoWorkersError, SchedulerLostError, reaching
from myograph.ensemble.running.plugin import solve_batch
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import row_path, state_of
from myograph.ensemble.store.writing import write_failure
from myograph.errors import InputError, NotConvergedError

Batch = tuple[int, ...]
_OUT_PER_THREAD = 3
_LOST_AT_MOST = 5
"""How often a batch is sent out again whose worker was lost more often than Dask allows."""
_PATIENCE = 60.0
"""Without any worker for so long [s], and none expected, a run ends."""


@dataclass
class Drive:
    """Sends batches to workers until all are done.

    Parameters
    ----------
    place
        Where the workers are.
    name
        Of the workers' plugin.
    store
        Where rows appear.
    listener
        Told the number of cases that have a row among those of this run, and the number of threads.
    seen
        Whether a worker was there before; until then a place may take as long as it wants to find one.
    """

    place: Workplace
    name: str
    store: Path
    listener: Listener
    seen: bool = False
    _out: dict[Future, Batch] = field(default_factory=dict)
    _lost: dict[Batch, int] = field(default_factory=dict)
    _finished: int = 0
    _threads: int = 0
    _asked: float = 0.0
    _last_seen: float = field(default_factory=time.monotonic)

    def run(self, todo: Sequence[Batch]) -> None:
        """Return when every batch is done.

        Raises InputError where the run must stop, NoWorkersError where no worker is left, SchedulerLostError where the
        scheduler does not answer.
        """
        waiting = deque(todo)
        while waiting or self._out:
            self._count_threads()
            while waiting and len(self._out) < max(1, _OUT_PER_THREAD * self._threads):
                batch = waiting.popleft()
                with reaching(self.place.client):
                    future = self.place.client.submit(solve_batch, self.name, batch, pure=False)
                self._out[future] = batch
            for future in self._arrived():
                again = self._take(future)
                waiting.extendleft(again)
            self.listener.ready(self._finished + self._under_way())

    def _arrived(self) -> list[Future]:
        with reaching(self.place.client):
            try:
                done: Any = wait(list(self._out), timeout=0.5, return_when="FIRST_COMPLETED")
            except TimeoutError:
                return []
            return list(done.done)

    def _take(self, future: Future) -> list[Batch]:
        """Count a finished batch; give back one that has to go out again."""
        batch = self._out.pop(future)
        if future.status == "finished":
            with reaching(self.place.client):
                stop = future.result()
            if stop:
                raise InputError(stop)
            self._finished += len(batch)
            return []
        problem: Any = future.exception() if future.status == "error" else None
        if problem is not None and not isinstance(problem, KilledWorker | SolverEndedError):
            raise problem
        self._lost[batch] = self._lost.get(batch, 0) + 1
        if self._lost[batch] <= _LOST_AT_MOST:
            return [batch]
        if isinstance(problem, SolverEndedError):
            raise SchedulerLostError("its solvers were ended from outside, again and again")
        self._give_up(batch)
        self._finished += len(batch)
        return []

    def _give_up(self, batch: Batch) -> None:
        plan, problem = read_plan(self.store), NotConvergedError("its worker was lost again and again")
        for case in batch:
            if state_of(self.store, case) is None:
                write_failure(self.store, plan, case, problem)

    def _under_way(self) -> int:
        return sum(row_path(self.store, case).exists() for batch in self._out.values() for case in batch)

    def _count_threads(self) -> None:
        now = time.monotonic()
        if now - self._asked < 2 and self._threads:
            return
        with reaching(self.place.client):
            threads: Any = self.place.client.nthreads()
        self._threads, self._asked = sum(threads.values()), now
        self.seen = self.seen or self._threads > 0
        self.listener.threads(self._threads)
        expected = self.place.expected(self.seen)
        if self._threads or expected:
            self._last_seen = now
        elif now - self._last_seen > _PATIENCE:
            raise NoWorkersError(f"no worker was there for {_PATIENCE:g} s")
