"""A handle on the simulator's own process: ask, wait as long as is allowed, end it."""

import json
import os
import queue
import subprocess
import sys
import threading
from dataclasses import asdict
from pathlib import Path
from typing import Any

from myograph.ensemble.running.chains import Step
from myograph.ensemble.spec import SimulatorSpec
from myograph.errors import InputError
from myograph.processes import ONE_THREAD


class ProcessDiedError(Exception):
    """The process ended before it answered."""


class TimeLimitError(Exception):
    """The process did not answer in time; it has been ended."""


class SimulatorProcess:
    """A simulator in a process of one thread; raises InputError where it cannot be made."""

    def __init__(self, store: Path, spec: SimulatorSpec) -> None:
        modules = os.pathsep.join(path for path in sys.path if path)
        environment = {**os.environ, **ONE_THREAD, "PYTHONPATH": modules}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "myograph.ensemble.running.child"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
            text=True,
            encoding="utf-8",
        )
        self._answers: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()
        self._say({"store": str(store), "simulator": asdict(spec)})
        answer = self._answer(None)
        if "broken" in answer:
            self.end()
            raise InputError(f"the simulator cannot be made: {answer['broken']}")

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    def solve(self, step: Step, seconds: float | None) -> dict[str, Any]:
        """What became of a step: {'state': ...}, or {'stop': reason} where the store cannot be written.

        Raises ProcessDiedError, and TimeLimitError after so many seconds.
        """
        self._say(asdict(step))
        return self._answer(seconds)

    def end(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except OSError:
                    continue

    def _say(self, message: dict[str, Any]) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(message) + "\n")
            self._process.stdin.flush()
        except (OSError, ValueError):
            raise ProcessDiedError from None

    def _answer(self, seconds: float | None) -> dict[str, Any]:
        try:
            line = self._answers.get(timeout=seconds)
        except queue.Empty:
            self.end()
            raise TimeLimitError from None
        if line is None:
            self.end()
            raise ProcessDiedError
        return json.loads(line)

    def _listen(self) -> None:
        assert self._process.stdout is not None
        try:
            for line in self._process.stdout:
                if line.endswith("\n"):
                    self._answers.put(line)
        except (OSError, ValueError):
            pass
        self._answers.put(None)
