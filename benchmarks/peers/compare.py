"""Peers and our methods on the same cases with the same time to learn: one table.

    python benchmarks/peers/compare.py STORE --python PEERS_ENVIRONMENT/bin/python [--seconds 60] [--seeds 1]
        [--protocols strict off_grid] [--only NAME ...] [--out peers.json]

Runs in myograph's environment; each peer runs in the peers' own (`requirements.lock`). A peer that cannot be
installed, or cannot do the task, keeps its row with the reason. All are told activations; `gen_thesis_8` and
`neural_modes, sensors` are told nine sensors instead. Errors are those of the test cases at all nodes but the sensors.
The clock ends training by steps; others take the time they take.
"""

import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import torch
from export_cases import arrays_of, cases_of
from run_peer import errors
from threadpoolctl import threadpool_limits

import myograph
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import PROTOCOLS, Protocol, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.fields import von_mises
from myograph.files import write_whole
from myograph.learning.learners import Asked, make_learner

HERE = Path(__file__).parent
PEERS = tuple(
    sorted(p.stem for p in (HERE / "adapters").glob("*_*.py") if p.stem not in ("__init__", "ezyrb_pod", "stepwise"))
)
OURS: dict[str, tuple[str, dict[str, object], str]] = {
    "neural_modes": ("neural_modes", {}, "activations"),
    "pod_gp": ("pod_gp", {}, "activations"),
    "feed_forward": ("feed_forward", {}, "activations"),
    "deeponet": ("deeponet", {}, "activations"),
    "gen_thesis_8": ("gen_thesis", {}, "sensors"),
    "neural_modes, sensors": ("neural_modes", {"reads": "sensors"}, "sensors"),
}
STEPPED = ("feed_forward", "deeponet", "gen_thesis")
COLUMNS = (
    "mean_mm",
    "p95_mm",
    "max_mm",
    "von_mises_mean_mpa",
    "train_s",
    "predict_ms",
    "numbers",
    "install_mb",
    "reads",
    "anywhere",
)
PAGE = """# Peers, one run

Written by `compare.py` from [peers.json](peers.json): at most {seconds:g} s of learning where a method is trained by
steps, means over {seeds} seed(s), one thread each, data {data}.
The limit and `train_s` are the processor's seconds, so that a busy machine takes nothing from anybody ({load:.0f} jobs
at once as this ended); `predict_ms` is by the clock on the wall. Ours get as many steps as fit into the limit.
What is alike and what is not: [README.md](README.md). `install_mb` is the package alone, without what it depends on.

"""
Rows = dict[tuple[str, str], dict[str, object]]
SPREAD = "mean_mm"
"""The figure whose deviation over the seeds is shown."""
LEAST_SPREAD = 1e-4
"""Of the figure: less is rounding."""
PROBES = (5, 35)
"""Steps of two short trainings: their difference says how many fit into the limit."""
PATIENCE = 600.0
"""Beyond the time to learn [s], until a peer is given up."""


def ours(name: str, cases: MuscleCases, protocol: Protocol, asked: argparse.Namespace, seed: int) -> dict[str, object]:
    """A method of ours, as peers are measured."""
    method, options, reads = OURS[name]
    stress = () if method == "gen_thesis" else ("von_mises",)
    convention = "initial" if method == "gen_thesis" else "material"
    sampler = PairSampler(cases, random_sensors(cases.nodes), convention, asked=("position", *stress))
    split = split_pairs(cases, protocol, seed)
    training: dict[str, object] = {"seed": seed} if method in STEPPED else {}

    def fit(**more: object) -> tuple[Predictor, float]:
        started = time.process_time()
        fitted = make_learner(Asked(method, options, training | more)).fit(sampler, split)
        return fitted, time.process_time() - started

    steps = {}
    if training:
        few, many = (fit(steps=count)[1] for count in PROBES)
        steps = {"steps": max(1, int(asked.seconds * (PROBES[1] - PROBES[0]) / (many - few)))}
    predictor, train_s = fit(**steps)
    targets = np.unique(split.test[:, 1])
    pairs = np.array([split.test[np.flatnonzero(split.test[:, 1] == target)[0]] for target in targets])
    answers = [predictor.predict(batch.question).values for batch in sampler.batches(pairs)]
    found = _everywhere(answers, sampler)
    question = sampler.batch(pairs[:1]).question
    times = []
    for _ in range(10):
        started = time.perf_counter()
        predictor.predict(question)
        times.append(time.perf_counter() - started)
    told = {"train_s": train_s, "predict_ms": 1000 * float(np.median(times)), "reads": reads}
    anywhere = method in ("gen_thesis", "deeponet")
    told["install_mb"] = sum(path.stat().st_size for path in Path(myograph.__file__).parent.rglob("*.*")) / 1e6
    numbers = sum(values.numel() for values in predictor.module.state_dict().values())  # type: ignore[attr-defined]
    return {**told, "anywhere": anywhere, "numbers": numbers, **errors(found, arrays_of(cases, seed), targets)}


def _everywhere(answers: list, sampler: PairSampler) -> dict[str, np.ndarray]:
    """Answers at all nodes; sensors are no errors of anybody, and are left out later."""
    found = {}
    for name in answers[0]:
        values = np.concatenate([answer[name] for answer in answers])
        whole = np.zeros((len(values), sampler.cases.nodes, *values.shape[2:]))
        whole[:, sampler.queries] = values
        found[name] = whole
    if "cauchy_stress" in found and "von_mises" not in found:
        found["von_mises"] = von_mises(found["cauchy_stress"])
    return found


def peer(name: str, cases: Path, protocol: str, asked: argparse.Namespace, seed: int) -> dict[str, object]:
    """A peer in its own environment; the reason where there is no answer."""
    if asked.python is None or not asked.python.exists():
        return {"reason": "no environment of the peers: see benchmarks/peers/README.md"}
    command = [asked.python, HERE / "run_peer.py", name, cases, "--protocol", protocol]
    command += ["--seconds", asked.seconds, "--seed", seed]
    try:
        done = subprocess.run(
            [str(part) for part in command],
            capture_output=True,
            text=True,
            check=False,
            timeout=asked.seconds + PATIENCE,
            env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
        )
    except subprocess.TimeoutExpired:
        return {"reason": f"no answer within {asked.seconds + PATIENCE:.0f} s"}
    try:
        return json.loads(done.stdout.strip().splitlines()[-1])
    except (IndexError, ValueError):
        return {"reason": (done.stderr.strip().splitlines() or ["no output"])[-1][:300]}


def mean_of(measured: list[dict[str, object]]) -> dict[str, object]:
    """Means over the seeds that answered, and how far they scatter; a reason where none did."""
    answered = [own for own in measured if "reason" not in own]
    if not answered:
        return measured[0]
    found = dict(answered[0])
    for key in [key for key, value in found.items() if isinstance(value, float)]:
        values = np.array([own[key] for own in answered], dtype=float)
        found[key] = float(values.mean())
        if key == SPREAD and len(values) > 1:
            found[f"{key}_std"] = float(values.std())
    return {**found, "answered": len(answered)}


def table(rows: list[dict[str, object]]) -> str:
    """Markdown."""
    lines = [["method", "protocol", *COLUMNS], ["---"] * (len(COLUMNS) + 2)]
    for row in rows:
        told = [f"not measured: {row['reason']}"] if "reason" in row else [_cell(row, key) for key in COLUMNS]
        lines.append([str(row["name"]), str(row["protocol"]), *told])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def page(told: dict[str, object]) -> str:
    """The table with what it was made from."""
    rows: list[dict[str, object]] = told["rows"]  # type: ignore[assignment]
    return PAGE.format(**told) + table(rows) + "\n"


def _cell(row: dict[str, object], key: str) -> str:
    value, spread = row.get(key), row.get(f"{key}_std")
    if not isinstance(value, float) or not isinstance(spread, float):
        return _short(value)
    return f"{_short(value)} ± {_short(spread if spread > LEAST_SPREAD * value else 0.0)}"


def _short(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:,.0f}" if isinstance(value, int) else f"{value:.3g}" if isinstance(value, float) else str(value)


def main() -> None:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--python", type=Path)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--support", type=int, default=512)
    parser.add_argument("--protocols", nargs="+", choices=PROTOCOLS, default=("strict", "off_grid"))
    parser.add_argument("--only", nargs="+", choices=(*OURS, *PEERS), default=(*OURS, *PEERS))
    parser.add_argument("--out", type=Path)
    asked = parser.parse_args()
    torch.set_num_threads(1)
    threadpool_limits(1)
    cases = cases_of(asked.store, asked.support)
    about = {"seconds": asked.seconds, "seeds": asked.seeds, "data": cases.checksum}
    rows = kept(asked.out, about)
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{seed}.npz" for seed in range(asked.seeds)]
        for seed, file in enumerate(files):
            np.savez(file, **arrays_of(cases, seed))
        for name in asked.only:
            for protocol in asked.protocols:
                measured = [
                    ours(name, cases, protocol, asked, seed)
                    if name in OURS
                    else peer(name, file, protocol, asked, seed)
                    for seed, file in enumerate(files)
                ]
                rows[name, protocol] = {"name": name, "protocol": protocol, **mean_of(measured)}
                print(table([rows[name, protocol]]).splitlines()[-1], flush=True)
                write(asked.out, {**about, "load": os.getloadavg()[0], "rows": in_order(rows)})
    print(table(in_order(rows)))


def kept(out: Path | None, about: dict[str, object]) -> Rows:
    """Rows of an earlier run on the same cases with the same limits; those that are asked for are measured again."""
    if out is None or not out.exists():
        return {}
    told = json.loads(out.read_text())
    same = all(told.get(key) == value for key, value in about.items())
    return {(row["name"], row["protocol"]): row for row in told["rows"]} if same else {}


def in_order(rows: Rows) -> list[dict[str, object]]:
    """Ours, then the peers."""
    names = [*OURS, *PEERS]
    return [rows[key] for key in sorted(rows, key=lambda key: (names.index(key[0]), key[1] != "strict"))]


def write(out: Path | None, told: dict[str, object]) -> None:
    """Results and their page, each whole."""
    if out is not None:
        for path, text in ((out, json.dumps(told, indent=1) + "\n"), (out.with_suffix(".md"), page(told))):
            write_whole(path, lambda file, text=text: file.write(text.encode()))


if __name__ == "__main__":
    main()
