"""Kill the runner of an ensemble, or a simulator of it, again and again, and see that the store comes out the same.

    python -m benchmarks.kill_ensemble [--kills 100] [--cases 2000] [--seed 0] [--remembers] [--json]

Every kill is a kill -9, every third of the runner, the others of one of its simulators' processes; a dead
runner is started again. At last the store is compared, byte by byte, with one that was left in peace.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from tests.ensemble import synthetic

from myograph.ensemble.design import DesignSpec, make_design
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.plan import read_plan

ROOT = Path(__file__).parents[1]
RUN = """
import sys
from pathlib import Path
from myograph.ensemble.running.run import RunOptions, run_store
run_store(Path(sys.argv[1]), RunOptions(workers=2))
"""


def main() -> None:
    """Disturb one store, leave another in peace, compare."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--cases", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--remembers", action="store_true", help="a simulator whose answers depend on those before")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    kind = synthetic.REMEMBERING if options.remembers else synthetic.FACTORY
    with tempfile.TemporaryDirectory() as folder:
        disturbed, peaceful = (
            new_store(Path(folder) / name, options.cases, kind) for name in ("disturbed", "peaceful")
        )
        killed = disturb(disturbed, options.kills, options.seed)
        run(peaceful).wait()
        result = {
            **killed,
            "equal": store_checksum(disturbed) == store_checksum(peaceful),
            "problems": len(list(check_store(disturbed, read_plan(disturbed)))),
        }
    print(json.dumps(result) if options.json else result)
    sys.exit(0 if result["equal"] and not result["problems"] else 1)


def new_store(path: Path, cases: int, kind: str, sleep: float = 0.02) -> Path:
    """A store of random cases of a synthetic simulator that takes so long for each [s]."""
    design = make_design([DesignSpec(method="tenths", count=cases)])
    plan, bodies = plan_store(design, synthetic.spec(kind, f"sleep={sleep}"), ("biceps",))
    make_store(path, plan, bodies, {})
    return path


def run(store: Path) -> subprocess.Popen:
    """A runner of its own."""
    return subprocess.Popen([sys.executable, "-c", RUN, str(store)], cwd=ROOT)


def disturb(store: Path, kills: int, seed: int) -> dict[str, int]:
    """Run a store to its end with so many kills on the way; how many runners and simulators were killed."""
    draw = random.Random(seed)
    killed = {"runners": 0, "simulators": 0}
    runner = run(store)
    while sum(killed.values()) < kills:
        before = ready(store)
        wait_for_rows(store, before + draw.randint(1, 5), runner)
        if runner.poll() is not None:
            break
        if sum(killed.values()) % 3 == 2:
            runner.kill()
            runner.wait()
            killed["runners"] += 1
            runner = run(store)
        elif victims := simulators(runner.pid):
            draw.choice(victims).kill()
            killed["simulators"] += 1
    runner.wait()
    return killed


def simulators(runner: int) -> list[psutil.Process]:
    """The simulators' processes of a runner."""
    try:
        return [
            child for child in psutil.Process(runner).children() if "myograph.ensemble.running.child" in child.cmdline()
        ]
    except psutil.Error:
        return []


def ready(store: Path) -> int:
    """Number of cases that have a row."""
    return sum(1 for _ in (store / "rows").iterdir())


def wait_for_rows(store: Path, number: int, runner: subprocess.Popen) -> None:
    """Return when there are so many rows, or the runner has ended."""
    while runner.poll() is None and ready(store) < number:
        time.sleep(0.005)


if __name__ == "__main__":
    main()
