"""The simulator's own process: `python -m myograph.ensemble.running.child`.

Reads one JSON object a line from standard input: first the store and the spec of the simulator, then steps; answers
each with one line. It ends when its input does, that is with its parent, in the middle of a solve too. What
simulators print goes nowhere.
"""

import json
import os
import queue
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from myograph.case import Simulator
from myograph.ensemble.simulators import made_anew, make_simulator
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.writing import write_failure, write_solution
from myograph.errors import MyographError

Answer = dict[str, Any]


def main() -> None:
    """Serve until the input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)

    def say(answer: Answer) -> None:
        answers.write(json.dumps(answer) + "\n")
        answers.flush()

    asked: queue.SimpleQueue[str] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(asked,), daemon=True).start()
    serve(asked.get, say)


def serve(ask: Callable[[], str], say: Callable[[Answer], None]) -> None:
    """Make the simulator, then answer steps for ever."""
    first = json.loads(ask())
    store, spec = Path(first["store"]), SimulatorSpec(**first["simulator"])
    try:
        plan, simulator = read_plan(store), make_simulator(spec)
    except Exception as problem:
        say({"broken": _words(problem)})
        return
    say({"ready": True})
    fresh = True
    while True:
        step = json.loads(ask())
        try:
            if step["fresh"] and not fresh:
                simulator, fresh = made_anew(simulator, spec), True
            state = _solve((store, plan), simulator, step)
        except OSError as problem:
            say({"stop": f"{store}: cannot be written ({problem.strerror}); free some room and run it again"})
            continue
        fresh = False
        say({"state": state})


def _solve(place: tuple[Path, StorePlan], simulator: Simulator, step: Answer) -> str:
    """Solve, store where asked, and say what became of it."""
    store, plan = place
    number = step["case"]
    try:
        solution = simulator(plan.design.cases[number])
    except Exception as problem:
        if not step["write"]:
            return "failed"
        return write_failure(store, plan, number, problem).state
    return write_solution(store, plan, number, solution).state if step["write"] else "done"


def _listen(asked: "queue.SimpleQueue[str]") -> None:
    for line in sys.stdin:
        asked.put(line)
    os._exit(0)


def _words(problem: Exception) -> str:
    return str(problem) if isinstance(problem, MyographError) else f"{type(problem).__name__}: {problem}"


if __name__ == "__main__":
    main()
