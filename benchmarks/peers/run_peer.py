"""One peer on one protocol: teach within a time limit, test, print one JSON object; run in the peers' environment.

    python benchmarks/peers/run_peer.py sklearn_pod cases.npz --protocol strict --seconds 60 --seed 0

An adapter is a module of `adapters` with `DOES` (what it reads, whether it can be asked anywhere, its package) and
fit(task) -> predict(activation (cases, 5)) -> {"position": (cases, nodes, 3), "von_mises": (cases, nodes)}.
An adapter that cannot be imported, or cannot do the task, becomes {"reason": ...}.
"""

import argparse
import importlib
import json
import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Task:
    """What teaches: arrays of the training cases, the body, the time limit [s], the processor's clock at its start."""

    activation: np.ndarray
    position: np.ndarray
    von_mises: np.ndarray
    reference: np.ndarray
    cells: np.ndarray
    seconds: float
    seed: int
    started: float


def run(adapter: str, cases: Path, protocol: str, seconds: float, seed: int) -> dict[str, object]:
    """Errors, times and numbers of a peer; or why there are none."""
    sys.path.insert(0, str(Path(__file__).parent))
    try:
        module = importlib.import_module(f"adapters.{adapter}")
    except ImportError as missing:
        return {"reason": f"cannot be imported: {missing}"}
    with np.load(cases) as file:
        data = dict(file)
    taught, tested = data[f"train_{protocol}"], data[f"test_{protocol}"]
    fields = [data[name][taught] for name in ("activation", "position", "von_mises")]
    task = Task(*fields, data["reference"], data["cells"], seconds, seed, time.process_time())
    try:
        predict = module.fit(task)
        learning = time.process_time() - task.started
        answer = predict(data["activation"][tested])
    except Exception as problem:
        return {"reason": " ".join(f"{type(problem).__name__}: {problem}".split())}
    told = {"train_s": learning, "predict_ms": _milliseconds(predict, data["activation"][tested[:1]]), **module.DOES}
    told |= {name: getattr(predict, name, None) for name in ("numbers", "steps")}
    told["install_mb"] = megabytes(module.DOES["package"])
    return {**told, **errors(answer, data, tested)}


def megabytes(package: str) -> float:
    """Size of an installed package, without what it depends on [MB]."""
    return size_of(Path(str(file.locate())) for file in metadata.files(package) or ())


def size_of(files: Iterable[Path]) -> float:
    """Of those that are there, but what Python compiled of them [MB]."""
    return sum(file.stat().st_size for file in files if file.is_file() and file.suffix != ".pyc") / 1e6


def errors(answer: dict[str, np.ndarray], data: dict[str, np.ndarray], tested: np.ndarray) -> dict[str, float]:
    """Distances of all nodes but the sensors [mm], errors of von Mises stress there [MPa]."""
    asked = np.setdiff1d(np.arange(len(data["reference"])), data["sensors"])
    distance = np.linalg.norm(answer["position"] - data["position"][tested], axis=-1)[:, asked]
    found = {
        "mean_mm": float(distance.mean()),
        "p95_mm": float(np.percentile(distance, 95)),
        "max_mm": float(distance.max()),
    }
    if "von_mises" in answer:
        stress = np.abs(answer["von_mises"] - data["von_mises"][tested])[:, asked]
        found["von_mises_mean_mpa"] = float(stress.mean())
    return found


def _milliseconds(predict: object, activation: np.ndarray) -> float:
    times = []
    for _ in range(10):
        started = time.perf_counter()
        predict(activation)  # type: ignore[operator]
        times.append(time.perf_counter() - started)
    return 1000 * float(np.median(times))


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("adapter")
    parser.add_argument("cases", type=Path)
    parser.add_argument("--protocol", default="off_grid")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    print(json.dumps(run(asked.adapter, asked.cases, asked.protocol, asked.seconds, asked.seed)))


if __name__ == "__main__":
    main()
