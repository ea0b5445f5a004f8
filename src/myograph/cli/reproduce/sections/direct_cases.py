"""Direct finite elements: does teaching on the table cost anything where the truth is a finite-element solve?"""

from collections.abc import Sequence
from dataclasses import replace

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import MODES, Experiment, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dots, heat
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Chosen, Trial
from myograph.evaluation import Figure


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Each method taught on either, always tested on direct cases."""
    corners, inside = data.numbers("direct", "factorial"), data.numbers("direct", "off_grid")
    data.cases("beside")
    direct = Chosen("direct", corners, inside)
    taught = {"direct": direct, "table": replace(direct, store="beside", truth="direct")}
    training = size.training(2)
    rows = [taught_twice("do_nothing", "do_nothing", direct, size)]
    for where, cases in taught.items():
        rows += [
            taught_twice(f"gen_thesis_8, {where}", "gen_thesis", cases, size, training=training),
            taught_twice(f"neural_modes, {where}", "neural_modes", cases, size, options=MODES),
            taught_twice(f"pod_gp, {where}", "pod_gp", cases, size),
        ]
    return [trial for row in sorted(rows, key=lambda row: row[0].method) for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Dots, and where the errors sit."""
    shown = [f"{method}, {where}" for method in ("gen_thesis_8", "neural_modes") for where in ("direct", "table")]
    return (
        dots(outcome, "Taught on direct finite elements or on the table, tested on direct finite elements."),
        *heat(outcome, shown, "off_grid", "mm"),
    )


EXPERIMENT = Experiment(trials, figures)
