"""Activation step: 32 cases at the corners, at halves, at tenths, or anywhere, tested on the same continuous ones."""

from collections.abc import Sequence

import numpy as np

from myograph.cli.reproduce.data import AT_A_STEP, CONTINUOUS, HALVES, SEED, TENTHS, TESTS, Data
from myograph.cli.reproduce.experiment import MODES, Experiment, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dots
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Chosen, Trial
from myograph.evaluation import Figure

WORDS = {
    "step 1.0": ("factorial",),
    "step 0.5": ("factorial", HALVES),
    "step 0.1": (TENTHS,),
    "continuous": (CONTINUOUS,),
}
"""Step -> where its 32 cases are drawn from."""


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """The thesis's network, the spline and neural modes, taught at each step."""
    rows = []
    for step, words in WORDS.items():
        cases = _cases(data, words)
        training = size.training(2)
        rows += [
            taught_twice(f"gen_thesis_8, {step}", "gen_thesis", cases, size, training=training),
            taught_twice(f"neural_modes, {step}", "neural_modes", cases, size, options=MODES),
        ]
    return [trial for row in sorted(rows, key=lambda row: row[0].method) for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Dots."""
    caption = (
        "Taught at each activation step: thesis and strict test on cases of the step's own, off_grid on the same "
        "continuous activations for all."
    )
    return (dots(outcome, caption),)


def _cases(data: Data, words: tuple[str, ...]) -> Chosen:
    numbers = np.array(data.numbers("steps", *words))
    drawn = np.sort(np.random.default_rng(SEED).permutation(numbers)[:AT_A_STEP])
    return Chosen("steps", tuple(drawn.tolist()), data.numbers("steps", TESTS))


EXPERIMENT = Experiment(trials, figures)
