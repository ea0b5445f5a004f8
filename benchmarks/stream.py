"""Stream a dataset that is larger than the memory it may take: all fields of many cases, as training reads them.

    python benchmarks/stream.py [--cases 2000] [--nodes 4027] [--random 4000] [--json]

A store of random numbers is written with the store's own writer into a temporary folder (12 numbers for each node and
case), then read in a fresh process in batches of 32 pairs: every case once in either role, then random pairs, all
fields told and asked at all nodes, in the convention 'material', whose reference coordinates make it 15 numbers. The
peak of that process's resident memory must stay below 1 GB.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

LIMIT_MB = 1000.0
BATCH = 32


def main() -> None:
    """Write the store, read it in another process, tell what that took; 1 where it took too much."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=2000)
    parser.add_argument("--nodes", type=int, default=4027)
    parser.add_argument("--random", type=int, default=4000, help="pairs that are drawn at random")
    parser.add_argument("--store", type=Path, help="read this store; what the fresh process is called with")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.store is not None:
        print(json.dumps(stream(options.store, options.random)))
        return
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        started = time.perf_counter()
        write(store, options.cases, options.nodes)
        written = time.perf_counter() - started
        size = sum(path.stat().st_size for path in store.rglob("*") if path.is_file()) / 1e6
        command = [sys.executable, __file__, "--store", str(store), "--random", str(options.random)]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    result = {"cases": options.cases, "nodes": options.nodes, "on_disk_mb": size, "write_s": written, **found}
    print(json.dumps(result) if options.json else result)
    sys.exit(0 if result["peak_mb"] < LIMIT_MB else 1)


def write(store: Path, cases: int, nodes: int) -> None:
    """A store of one muscle with random numbers in all fields."""
    from myograph.anatomy.load import built_in_arm
    from myograph.case import Solution
    from myograph.ensemble.design import DesignSpec, make_design
    from myograph.ensemble.spec import Body, SimulatorSpec
    from myograph.ensemble.store.making import make_store
    from myograph.ensemble.store.plan import StorePlan
    from myograph.ensemble.store.writing import write_solution
    from myograph.fields import FIELDS

    draw = np.random.default_rng(0)
    design = make_design([DesignSpec(method="tenths", count=cases)])
    spec = SimulatorSpec("random", "", built_in_arm().model_dump_json())
    plan = StorePlan(design, spec, {"arm_checksum": ""}, ("biceps",), {"biceps": nodes}, {})
    body = Body(draw.normal(size=(nodes, 3)) * 50, np.arange(8).reshape(2, 4), np.arange(8).reshape(1, 8))
    plan = make_store(store, plan, {"biceps": body}, {})
    shapes = {name: (nodes, len(FIELDS[name].components) or 1) for name in plan.fields}
    for number, case in enumerate(design.cases):
        fields = {name: draw.normal(size=shape) for name, shape in shapes.items()}
        fields = {name: values if FIELDS[name].components else values[:, 0] for name, values in fields.items()}
        write_solution(store, plan, number, Solution(case, 1.0, {}, {"biceps": fields}, "random"))


def stream(store: Path, random: int) -> dict[str, float]:
    """Read every case in both roles, then random pairs; pairs, seconds, and the peak of resident memory [MB]."""
    from myograph.ensemble.pairs.protocols import PairSet
    from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
    from myograph.ensemble.store.reading import read_muscle

    started = time.perf_counter()
    cases = read_muscle(store, "biceps")
    sampler = PairSampler(cases, random_sensors(cases.nodes), "material", cases.fields, cases.fields)
    every = np.arange(len(cases))
    drawn = PairSet(every, every).draw(np.random.default_rng(0), random)
    opened, worked = time.perf_counter(), time.process_time()
    total, pairs = 0.0, np.concatenate([np.stack([every, every[::-1]], axis=1), drawn])
    for batch in sampler.batches(pairs, BATCH):
        total += sum(float(values.sum()) for values in batch.truth.values()) + float(batch.question.query_places.sum())
    assert np.isfinite(total)
    seconds, worked = time.perf_counter() - opened, time.process_time() - worked
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6
    times = {"open_s": opened - started, "stream_s": seconds, "stream_cpu_s": worked}
    return {"pairs": len(pairs), **times, "peak_mb": peak}


if __name__ == "__main__":
    main()
