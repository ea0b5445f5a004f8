"""One batch of cases from its first to its last row, whatever happens to the simulator's process on the way."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from myograph.ensemble.running.chains import Step, steps
from myograph.ensemble.running.process import ProcessDiedError, SimulatorProcess, TimeLimitError
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import state_of
from myograph.ensemble.store.writing import write_failure
from myograph.errors import InputError, NotConvergedError


class SolverEndedError(Exception):
    """The solver was ended from outside: whoever holds the store now has not asked for this batch."""


@dataclass(frozen=True)
class Task:
    """What every batch of a run has in common.

    Parameters
    ----------
    store
        Where answers go; every worker sees this path.
    simulator
        How to make the simulator.
    seconds
        A case that takes longer [s] has failed; None: as long as it wants.
    retries
        How often a case is tried again when its process is lost.
    """

    store: str
    simulator: SimulatorSpec
    seconds: float | None
    retries: int


class BatchSolver:
    """Solves batches, with one simulator's process that is made again when it is lost. For one thread.

    Another thread may end it; then nothing is computed or written any more.
    """

    def __init__(self, task: Task) -> None:
        self._task = task
        self._store = Path(task.store)
        self._process: SimulatorProcess | None = None
        self._ended = threading.Event()

    def solve(self, batch: Sequence[int]) -> str:
        """Give every case of a batch its row. Returns why the whole run must stop; empty where it need not.

        Raises SolverEndedError once it is ended.
        """
        lost: dict[int, int] = {}
        given_up: set[int] = set()
        try:
            while todo := self._todo(batch, given_up):
                stop = self._walk(todo, lost, given_up)
                if stop:
                    return stop
        except InputError as problem:
            return str(problem)
        except OSError as problem:
            return f"{self._store}: cannot be written ({problem.strerror}); free some room and run it again"
        return ""

    def end(self) -> None:
        """End the simulator's process, for good."""
        self._ended.set()
        process = self._process
        if process is not None:
            process.end()

    def _check_not_ended(self) -> None:
        if self._ended.is_set():
            raise SolverEndedError

    def _todo(self, batch: Sequence[int], given_up: set[int]) -> list[Step]:
        """What is left to solve; a stored case that could not be solved again counts as failed here."""
        return steps(
            batch,
            lambda case: "failed" if case in given_up else state_of(self._store, case),
            self._task.simulator.remembers,
        )

    def _walk(self, todo: Sequence[Step], lost: dict[int, int], given_up: set[int]) -> str:
        """Go through the steps until one fails or all are done; a failure changes what the next steps need."""
        for step in todo:
            process = self._started()
            try:
                answer = process.solve(step, self._task.seconds)
            except TimeLimitError:
                self._process = None
                return self._fail(step, f"took longer than {self._task.seconds:g} s", given_up)
            except ProcessDiedError:
                self._check_not_ended()
                self._process = None
                lost[step.case] = lost.get(step.case, 0) + 1
                if lost[step.case] > self._task.retries:
                    return self._fail(step, f"its process died {lost[step.case]} times", given_up)
                return ""
            if "stop" in answer:
                return answer["stop"]
            if answer["state"] == "failed" and self._task.simulator.remembers:
                given_up |= set() if step.write else {step.case}
                return ""
        return ""

    def _fail(self, step: Step, reason: str, given_up: set[int]) -> str:
        """The step's case has failed, unless its process came to write the answer before it ended."""
        self._check_not_ended()
        if not step.write:
            given_up.add(step.case)
        elif state_of(self._store, step.case) != "done":
            write_failure(self._store, read_plan(self._store), step.case, NotConvergedError(reason))
        return ""

    def _started(self) -> SimulatorProcess:
        """The process; raises InputError where the simulator cannot be made, or dies of it again and again."""
        for _ in range(self._task.retries + 1):
            self._check_not_ended()
            try:
                process = self._process = self._process or SimulatorProcess(self._store, self._task.simulator)
            except ProcessDiedError:
                continue
            if self._ended.is_set():
                process.end()
            self._check_not_ended()
            return process
        raise InputError("the simulator cannot be made: its process died every time")
