"""The same muscle by us and by FElupe: same mesh, same law, same load steps, same tolerance; time, memory, answers.

    python benchmarks/fe.py --make-felupe DIR          once: an environment of its own for FElupe
    python benchmarks/fe.py --felupe-python DIR/bin/python [--preset quick] [--muscle biceps] [--repeats 3] [--json]
                            [--variants tensortrax+scipy jax+scipy jax+pardiso]

FElupe is GPL: it is no dependency, and nothing of this project imports it. Both sides run as processes of one thread on
one processor, in turn; medians over the repeats. A variant of FElupe is who differentiates the law and who solves the
linear systems. Exit code 2 where the environment is missing, 1 where the two answers differ, for then the times mean
nothing. Aim: ours at least three times as fast.
"""

import argparse
import json
import os
import subprocess
import sys
import venv
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).parent
PACKAGES = {"tensortrax": "tensortrax", "jax": "jax", "pardiso": "pypardiso", "scipy": "scipy"}
"""Parts of a variant's name -> the packages that bring them."""
VARIANTS = ("tensortrax+scipy", "jax+scipy", "jax+pardiso")
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL")} | {
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false",
    "JAX_PLATFORMS": "cpu",
}
AGREEMENT = 0.01
"""Largest difference between the two answers, relative to the moment and to the largest displacement."""
AIM = 3.0
PHASES = ("setup", "matrix", "linear", "rest", "walk")
ROWS = {
    "setup": "preparation, s",
    "matrix": "assembly of a tangent, s",
    "linear": "its linear solve, s",
    "rest": "rest of a Newton step, s",
    "step": "a Newton step, s",
    "step_cpu": "a Newton step, s of processor",
    "walk": "all load steps, s",
    "walk_cpu": "all load steps, s of processor",
    "total": "preparation and load steps, s",
    "memory_mb": "peak memory, MB",
    "newton_steps": "Newton steps",
}
BUSY = 1.2
"""Wall over processor from which on the machine was too busy for its clock to mean anything."""


def main() -> None:
    """Make the environment, or run both sides and print the ratios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--make-felupe", type=Path, metavar="DIR")
    parser.add_argument("--felupe-python", type=Path, metavar="PATH")
    parser.add_argument("--preset", default="quick")
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--variants", nargs="+", default=list(VARIANTS), choices=VARIANTS)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    python = make_environment(options.make_felupe) if options.make_felupe else options.felupe_python
    complaint = missing(python, options.variants)
    if complaint:
        parser.error(complaint)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    with TemporaryDirectory() as folder:
        report = compare(options, python, Path(folder))
    if options.json:
        sys.stdout.write(json.dumps(report) + "\n")
    else:
        show(report)
    sys.exit(0 if all(row["agrees"] for row in report["answers"].values()) else 1)


def make_environment(folder: Path) -> Path:
    """A virtual environment with FElupe and all that the variants need; its Python."""
    venv.create(folder, with_pip=True)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    install = [python, "-m", "pip", "install", "--quiet", "felupe", *PACKAGES.values()]
    if subprocess.run(install).returncode:
        sys.stderr.write(f"{folder}: pip could not install {' '.join(install[5:])}; its words are above\n")
        sys.exit(2)
    return python


def missing(python: Path | None, variants: list[str]) -> str:
    """What is wrong with FElupe's environment and what to do; nothing if it will do."""
    make = f"make one:  python {Path(__file__).name} --make-felupe DIR"
    if python is None:
        return f"FElupe needs an environment of its own, got none: give its Python by --felupe-python, or {make}"
    modules = ["felupe", *sorted({PACKAGES[part] for variant in variants for part in variant.split("+")})]
    code = f"import importlib.util as u; print(*(m for m in {modules} if u.find_spec(m) is None))"
    try:
        absent = subprocess.run([python, "-I", "-c", code], check=True, capture_output=True, text=True).stdout.split()
    except (OSError, subprocess.CalledProcessError) as problem:
        return f"--felupe-python: expected a Python that runs, got {python} ({problem}); {make}"
    if absent:
        names = " ".join(absent)
        return f"--felupe-python: {python} lacks {names}: {python} -m pip install {names}, or {make}"
    return ""


def compare(options: argparse.Namespace, python: Path, folder: Path) -> dict:
    """Run both sides in turn, as often as asked; medians, ratios and differences."""
    problem, script = folder / "problem.npz", HERE / "fe_ours.py"
    run([sys.executable, script, problem, "--write", "--preset", options.preset, "--muscle", options.muscle])
    sides = {"ours": [sys.executable, script, problem, "--solve", folder / "ours.npz"]}
    for variant in options.variants:
        derivatives, solver = variant.split("+")
        command = [python, HERE / "fe_felupe.py", problem, folder / f"{variant}.npz"]
        sides[variant] = [*command, "--derivatives", derivatives, "--solver", solver]
    costs: dict[str, list[dict]] = {name: [] for name in sides}
    for _ in range(options.repeats):
        for name, command in sides.items():
            costs[name].append(json.loads(run(command).splitlines()[-1]))
    medians = {name: summary(runs) for name, runs in costs.items()}
    with np.load(problem) as file:
        rest = file["points"]
    answers = {name: difference(folder / "ours.npz", folder / f"{name}.npz", rest) for name in options.variants}
    ratios = {name: ratio(medians[name], medians["ours"]) for name in options.variants}
    size = {"preset": options.preset, "muscle": options.muscle, "repeats": options.repeats}
    return {**size, "unknowns": costs["ours"][0]["unknowns"], "medians": medians, "ratios": ratios, "answers": answers}


def run(command: list) -> str:
    """What a process of one thread prints; leave with its exit code where it fails."""
    done = subprocess.run(command, env=os.environ | ONE_THREAD, capture_output=True, text=True)
    if done.returncode:
        sys.stderr.write(done.stderr)
        sys.exit(done.returncode)
    return done.stdout


def summary(runs: list[dict]) -> dict[str, float]:
    """Medians over the runs of what one side took; a phase of a run is its seconds by wall and by processor."""
    return {key: median(details(cost)[key] for cost in runs) for key in ROWS}


def details(cost: dict) -> dict[str, float]:
    """One run, row by row; tangent, linear solve and rest per Newton step."""
    wall, cpu = ({phase: cost[phase][k] for phase in PHASES} for k in (0, 1))
    steps = cost["newton_steps"]
    per_step = {phase: wall[phase] / steps for phase in ("matrix", "linear", "rest")}
    whole = {"step": wall["walk"] / steps, "step_cpu": cpu["walk"] / steps, "walk_cpu": cpu["walk"]}
    return {**cost, **wall, **per_step, **whole, "total": wall["setup"] + wall["walk"]}


def ratio(theirs: dict[str, float], ours: dict[str, float]) -> dict[str, float]:
    """Theirs over ours, row by row."""
    return {key: theirs[key] / ours[key] for key in ROWS}


def difference(ours: Path, theirs: Path, rest: np.ndarray) -> dict:
    """How far two answers lie apart, relative to the moment and to the largest displacement."""
    with np.load(ours) as a, np.load(theirs) as b:
        largest = np.linalg.norm(a["positions"] - rest, axis=1).max()
        displacement = np.linalg.norm(a["positions"] - b["positions"], axis=1).max() / largest
        moment = abs(b["moment"] / a["moment"] - 1)
    agrees = bool(displacement < AGREEMENT and moment < AGREEMENT)
    return {"displacement": float(displacement), "moment": float(moment), "agrees": agrees}


def show(report: dict) -> None:
    """Print the table, the differences, and what the fastest variant says of the aim."""
    console, medians, ratios = Console(width=140), report["medians"], report["ratios"]
    title = "{muscle}, {preset} mesh, {unknowns} unknowns, median of {repeats}".format(**report)
    table = Table("", "ours", *(f"FElupe {name}" for name in ratios), title=title)
    for key, label in ROWS.items():
        cells = [f"{medians[name][key]:.4g} ({row[key]:.2f} x)" for name, row in ratios.items()]
        table.add_row(label, f"{medians['ours'][key]:.4g}", *cells)
    for key in ("displacement", "moment"):
        cells = [f"{row[key]:.1e}" for row in report["answers"].values()]
        table.add_row(f"difference of the {key}", "", *cells)
    console.print(table)
    for key in ("step", "step_cpu", "total", "memory_mb"):
        best = min(ratios, key=lambda name: ratios[name][key])
        console.print(f"{ROWS[key]}: FElupe's best, {best}, takes {ratios[best][key]:.2f} times ours")
    console.print(f"aim: {AIM:g} times in seconds")
    if any(cost["walk"] > BUSY * cost["walk_cpu"] for cost in medians.values()):
        console.print("the machine was busy: trust the seconds of the processor")
    for name, row in report["answers"].items():
        if not row["agrees"]:
            console.print(f"{name} gives another answer than ours: its times mean nothing")


if __name__ == "__main__":
    main()
