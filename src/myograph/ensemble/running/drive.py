"""The loop of a run: batches go out as workers are free, what comes back is counted.

Never more than three batches a thread are out, so that neither the scheduler nor this process grows with the number of
cases.
"""

import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from distributed import Client, Future, KilledWorker, wait

from myograph.ensemble.running.plugin import solve_batch
from myograph.ensemble.store.rows import Row, row_path, state_of, write_row
from myograph.errors import InputError

Batch = tuple[int, ...]
_OUT_PER_THREAD = 3
_LOST_AT_MOST = 5
"""How often a batch is sent out again whose worker was lost more often than Dask allows."""
_PATIENCE = 60.0
"""Without any worker for so long [s], a run ends."""


class NoWorkersError(Exception):
    """All workers are gone and none came back."""


@dataclass
class Drive:
    """Sends batches to workers until all are done.

    Parameters
    ----------
    client
        Of the scheduler.
    name
        Of the workers' plugin.
    store
        Where rows appear.
    ready
        Called with the number of cases that have a row among those of this run.
    """

    client: Client
    name: str
    store: Path
    ready: Callable[[int], None]
    _out: dict[Future, Batch] = field(default_factory=dict)
    _lost: dict[Batch, int] = field(default_factory=dict)
    _finished: int = 0
    _threads: int = 0
    _asked: float = 0.0
    _last_seen: float = field(default_factory=time.monotonic)

    def run(self, todo: Sequence[Batch]) -> None:
        """Return when every batch is done.

        Raises InputError where the run must stop, NoWorkersError where no worker is left.
        """
        waiting = deque(todo)
        while waiting or self._out:
            self._count_threads()
            while waiting and len(self._out) < max(1, _OUT_PER_THREAD * self._threads):
                batch = waiting.popleft()
                future = self.client.submit(solve_batch, self.name, batch, pure=False)
                self._out[future] = batch
            for future in self._arrived():
                again = self._take(future)
                waiting.extendleft(again)
            self.ready(self._finished + self._under_way())

    def _arrived(self) -> list[Future]:
        try:
            done: Any = wait(list(self._out), timeout=0.5, return_when="FIRST_COMPLETED")
            return list(done.done)
        except TimeoutError:
            return []

    def _take(self, future: Future) -> list[Batch]:
        """Count a finished batch; give back one that has to go out again."""
        batch = self._out.pop(future)
        if future.status == "finished":
            stop = future.result()
            if stop:
                raise InputError(stop)
            self._finished += len(batch)
            return []
        problem: Any = future.exception() if future.status == "error" else None
        if problem is not None and not isinstance(problem, KilledWorker):
            raise problem
        self._lost[batch] = self._lost.get(batch, 0) + 1
        if self._lost[batch] <= _LOST_AT_MOST:
            return [batch]
        for case in batch:
            if state_of(self.store, case) is None:
                write_row(self.store, Row(case, "failed", reason="its worker was lost again and again"))
        self._finished += len(batch)
        return []

    def _under_way(self) -> int:
        return sum(row_path(self.store, case).exists() for batch in self._out.values() for case in batch)

    def _count_threads(self) -> None:
        now = time.monotonic()
        if now - self._asked < 2 and self._threads:
            return
        threads: Any = self.client.nthreads()
        self._threads, self._asked = sum(threads.values()), now
        if self._threads:
            self._last_seen = now
        elif now - self._last_seen > _PATIENCE:
            raise NoWorkersError
