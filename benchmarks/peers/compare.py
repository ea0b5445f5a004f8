"""Peers and our methods on the same cases with the same time to learn: one table.

    python benchmarks/peers/compare.py STORE --python PEERS_ENVIRONMENT/bin/python [--seconds 60] [--seeds 1]
        [--protocols strict off_grid] [--only NAME ...] [--out peers.json]

Runs in myograph's environment; each peer runs in the peers' own (`requirements.lock`). A peer that cannot be
installed, or cannot do the task, keeps its row with the reason. All are told activations; `gen_thesis_8` and
`neural_modes, sensors` are told nine sensors instead. Errors are those of the test cases at all nodes but the sensors.
Seed k is tested, under `off_grid`, on the k-th 64 cases of that design. Methods trained by steps stop at so many
seconds of the processor; others take the time they take.
Rows that `--out` has are kept with `--only` and `--protocols`, where cases and limits are the same. A kept row is
measured again where its code has changed: the adapter, or `myograph.learning` for ours.
"""

import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import torch
from export_cases import arrays_of, cases_of, of_seed
from ours import OURS, ours
from page import page, table
from sources import code_of_ours, code_of_peer
from threadpoolctl import threadpool_limits

from myograph.ensemble.pairs.protocols import PROTOCOLS
from myograph.errors import InputError
from myograph.files import write_whole

HERE = Path(__file__).parent
FLOOR = "mean_shape"
ADAPTERS = (file.stem for file in (HERE / "adapters").glob("*.py") if "def fit(" in file.read_text())
PEERS = tuple(sorted(name for name in ADAPTERS if name != FLOOR))
NAMES = (FLOOR, *OURS, *PEERS)
Row = dict[str, object]
Key = tuple[str, str]
SPREAD = "mean_mm"
"""The figure whose deviation over the seeds is shown."""
PATIENCE = 3600.0
"""By the clock on the wall [s], until a peer is given up: a busy machine may give it a small share."""


def peer(name: str, cases: Path, protocol: str, asked: argparse.Namespace, seed: int) -> Row:
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
            timeout=PATIENCE,
            env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
        )
    except subprocess.TimeoutExpired:
        return {"reason": f"no answer within {PATIENCE:.0f} s"}
    try:
        return json.loads(done.stdout.strip().splitlines()[-1])
    except (IndexError, ValueError):
        return {"reason": (done.stderr.strip().splitlines() or ["no output"])[-1][:300]}


def mean_of(measured: list[Row]) -> Row:
    """Means over the seeds that answered, and how far they scatter; a reason where none did."""
    answered = [own for own in measured if "reason" not in own]
    if not answered:
        return measured[0]
    found = dict(answered[0])
    for key in [key for key, value in found.items() if isinstance(value, float)]:
        values = np.array([own[key] for own in answered], dtype=float)
        found[key] = float(values.mean())
        if key == SPREAD and len(values) > 1:
            found[f"{key}_std"] = float(values.std(ddof=1))
    if len(answered) < len(measured):
        found["failed"] = [own["reason"] for own in measured if "reason" in own]
    return {**found, "answered": len(answered), "asked": len(measured)}


def main() -> None:
    """Measure, print, keep."""
    asked = _arguments()
    torch.set_num_threads(1)
    threadpool_limits(1)
    try:
        cases = cases_of(asked.store, asked.support, asked.seeds)
        about = {"seconds": asked.seconds, "seeds": asked.seeds, "data": cases.checksum}
        rows = kept(asked.out, about)
    except InputError as problem:
        raise SystemExit(f"compare.py: {problem}") from problem
    seeds = [of_seed(cases, seed) for seed in range(asked.seeds)]
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{seed}.npz" for seed in range(asked.seeds)]
        for seed, file in enumerate(files):
            np.savez(file, **arrays_of(seeds[seed], seed))
        for name, protocol in due(rows, asked.only, asked.protocols):
            row = {"name": name, "protocol": protocol, "code": code_of(name)}
            measured = [
                ours(name, seeds[seed], protocol, asked.seconds, seed)
                if name in OURS
                else peer(name, file, protocol, asked, seed)
                for seed, file in enumerate(files)
            ]
            rows[name, protocol] = {**row, **mean_of(measured)}
            print(table([rows[name, protocol]]).splitlines()[-1], flush=True)
            write(asked.out, {**about, "load": os.getloadavg()[0], "rows": in_order(rows)})
    print(table(in_order(rows)))


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--python", type=Path)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--support", type=int, default=512)
    parser.add_argument("--protocols", nargs="+", choices=PROTOCOLS, default=("strict", "off_grid"))
    parser.add_argument("--only", nargs="+", choices=NAMES, default=NAMES)
    parser.add_argument("--out", type=Path)
    return parser.parse_args()


def kept(out: Path | None, about: Row) -> dict[Key, Row]:
    """Rows of an earlier run, of the methods that there are.

    Raises InputError for rows of other cases or limits, which would be lost.
    """
    if out is None or not out.exists():
        return {}
    told = json.loads(out.read_text())
    for key, value in about.items():
        if told.get(key) != value:
            raise InputError(f"{out}: expected rows of {key} {value}, got {told.get(key)}; name another --out")
    return {(row["name"], row["protocol"]): row for row in told["rows"] if row["name"] in NAMES}


def due(rows: dict[Key, Row], names: tuple[str, ...], protocols: tuple[str, ...]) -> list[Key]:
    """What is asked for, and what is kept from other code."""
    stale = {key for key, row in rows.items() if row.get("code") != code_of(key[0])}
    asked = {(name, protocol) for name in names for protocol in protocols}
    return [(name, protocol) for name in NAMES for protocol in PROTOCOLS if (name, protocol) in asked | stale]


def code_of(name: str) -> str:
    """Checksum of a method's code."""
    return code_of_ours() if name in OURS else code_of_peer(name)


def in_order(rows: dict[Key, Row]) -> list[Row]:
    """What knows nothing, ours, then the peers."""
    return [rows[name, protocol] for name in NAMES for protocol in PROTOCOLS if (name, protocol) in rows]


def write(out: Path | None, told: Row) -> None:
    """Results and their page, each whole."""
    if out is not None:
        for path, text in ((out, json.dumps(told, indent=1) + "\n"), (out.with_suffix(".md"), page(told))):
            write_whole(path, lambda file, text=text: file.write(text.encode()))


if __name__ == "__main__":
    main()
