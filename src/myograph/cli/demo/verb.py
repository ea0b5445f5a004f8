"""The verb `demo`, and the same as a function."""

import shlex
import sys
import time
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.cli.demo.sizes import SEED, SENSORS, demo_size
from myograph.cli.options import ArmFile, Json, Preset, print_json, read_arm
from myograph.cli.progress import Steps
from myograph.errors import InputError, MissingPackageError

_NEEDED = ("ngsolve", "torch", "tensorboard", "onnxscript", "matplotlib")
_VERSIONS = ("myograph", "ngsolve", "torch", "numpy", "scipy")


def demo(
    preset: Preset = "quick",
    out: Annotated[Path, typer.Option(help="Folder for the report, the ensemble, the tables and the models.")] = Path(
        "myograph-demo"
    ),
    arm_file: ArmFile = None,
    json: Json = False,
) -> None:
    """Simulate the arm, teach the networks, and write a report: the main job, from nothing.

    Tables and trainings that lie ready in the folder, made for the same arm and preset, are used again.
    """
    result = run_demo(read_arm(arm_file), preset, out, Steps())
    if json:
        print_json(result)
        return
    typer.echo(f"{'method':20} {'protocol':10} {'mean':>8} {'RMSE':>8} {'95 %':>8} {'max':>8}   [mm]")
    for method, row in result["methods"].items():
        for protocol, e in row.items():
            figures = " ".join(f"{e[key]:8.2f}" for key in ("mean_mm", "rmse_mm", "p95_mm", "max_mm"))
            typer.echo(f"{method:20} {protocol:10} {figures}")
    typer.echo(f"report: {result['report']}  ({result['seconds']['total']:.0f} s)")


def run_demo(arm: Arm, preset: str, out: Path, steps: Steps) -> dict[str, Any]:
    """Do the whole job into the folder `out`; return what `--json` prints.

    Raises InputError for a folder that cannot be written, NotConvergedError where a solve fails.
    """
    started = time.perf_counter()
    size = demo_size(preset)
    _check_installed()
    _check_writable(out)
    from myograph.cli.demo.networks import compare, learn, save
    from myograph.cli.demo.report import write_demo_report
    from myograph.cli.demo.simulation import simulate

    simulation = simulate(arm, preset, size, out, steps)
    simulated = time.perf_counter() - started
    comparison = compare(simulation.cases, learn(simulation.store, size, out, steps), steps)
    command = shlex.join(["myograph", *sys.argv[1:]])
    save(comparison, out, command, steps)
    provenance = {
        "command": command,
        "seed": str(SEED),
        "sensors": str(SENSORS),
        "arm": arm_checksum(arm),
        "dataset": simulation.cases.checksum,
        "versions": ", ".join(f"{name} {version(name)}" for name in _VERSIONS),
    }
    report = write_demo_report(simulation, comparison, steps, provenance, out / "report.html")
    return {
        "preset": preset,
        "seconds": {
            "simulate": round(simulated, 2),
            "train": round(steps.seconds["training"], 2),
            "total": round(time.perf_counter() - started, 2),
        },
        "nodes": simulation.cases.nodes,
        "cases": len(simulation.cases),
        "methods": {
            method: {
                protocol: {key: getattr(e, key) for key in ("mean_mm", "rmse_mm", "p95_mm", "max_mm")}
                for protocol, e in row.items()
            }
            for method, row in comparison.summaries.items()
        },
        "report": str(report),
    }


def _check_installed() -> None:
    for package in _NEEDED:
        if find_spec(package) is None:
            raise MissingPackageError(package, "all", "the demo")


def _check_writable(out: Path) -> None:
    try:
        out.mkdir(parents=True, exist_ok=True)
        probe = out / ".writable"
        probe.touch()
        probe.unlink()
    except OSError as problem:
        raise InputError(
            f"{out}: expected a folder that can be written, got: {problem.strerror}; choose --out"
        ) from None
