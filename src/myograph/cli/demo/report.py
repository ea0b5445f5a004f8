"""The demo's report: words, tables and figures together."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from myograph.cli.demo.networks import Comparison
from myograph.cli.demo.pictures import figures
from myograph.cli.demo.simulation import Simulation
from myograph.cli.demo.sizes import SENSORS
from myograph.cli.progress import Steps
from myograph.evaluation import Report, write_report

_LIMITS = (
    "The muscles act on each other through the elbow's angle only: they do not touch each other.",
    "Forces of biceps and triceps miss those of a published two-muscle model by about 5 and 17 per cent; those of the"
    " other three are scaled by published peak forces, not measured.",
    "Cases come from tables of finite-element states with smooth interpolation in between, not from one solve each.",
    "The networks are the thesis's, 5,860 parameters, with its traps set right; they answer with displacements, and a"
    " node of the graph takes the mean of the sensors' shares. As there, queries are named by where they start.",
    "One seed: the errors of the networks scatter between seeds, most after short training.",
)


def write_demo_report(
    simulation: Simulation, comparison: Comparison, steps: Steps, provenance: Mapping[str, str], path: Path
) -> Path:
    """Write `report.html`; returns its path."""
    with steps.timed("figures"):
        pictures = figures(simulation, comparison)
    cases = simulation.cases
    angles = np.degrees(cases.elbow_angle)
    states = sum(table.size for table in simulation.tables.values())
    newton = np.mean([table.record.newton_steps.mean() for table in simulation.tables.values()])
    strict = {method: row["strict"].mean for method, row in comparison.errors.items()}
    best = min((method for method in strict if method.startswith("gen")), key=strict.__getitem__)
    reached, nothing = strict[best], strict["do_nothing"]
    summary = (
        f"Five muscles of the {simulation.arm.name} were solved by finite elements in {states} states"
        f" ({newton:.1f} Newton steps each), and the elbow's equilibrium was found for {len(cases)} activations,"
        f" from {angles.min():.0f} to {angles.max():.0f} degrees.",
        f"From {SENSORS} known nodes of the biceps, each method predicts the other {cases.nodes - SENSORS}.",
        f"On activations never seen in training (protocol strict), {best} is wrong by {reached:.2f} mm in the mean,"
        f" where doing nothing is wrong by {nothing:.2f} mm: a factor of {nothing / reached:.1f}.",
    )
    title = f"myograph demo, preset {simulation.preset}"
    report = Report(title, summary, comparison.summaries, pictures, steps.seconds, provenance, _LIMITS)
    write_report(report, path)
    return path
