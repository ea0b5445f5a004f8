"""Section 6.2.4: smaller encoders, decoders and latent spaces; training curves with bands over seeds."""

from collections.abc import Sequence

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import curves, dots
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure

CONFIGURATIONS: dict[str, tuple[tuple[int, ...], int]] = {
    "32-32, latent 32": ((32, 32), 32),
    "16, latent 16": ((16,), 16),
    "8-8, latent 16": ((8, 8), 16),
    "8, latent 8": ((8,), 8),
    "16, latent 1": ((16,), 1),
    "16, latent 8": ((16,), 8),
}
"""Name -> hidden layers of encoder and decoder, size of the latent space: green, orange, red, blue and purple in the
thesis's figure; the last is the least that its conclusion allows, and was not trained there."""


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """All configurations, from several seeds."""
    few, training = corners(data), size.training(size.complexity)
    rows = []
    for name, (hidden, latent) in CONFIGURATIONS.items():
        options = {"nodes_per_axis": size.complexity, "hidden": hidden, "latent": latent}
        rows.append(taught_twice(name, "gen_thesis", few, size, size.seeds, options=options, training=training))
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Curves and dots."""
    seeds = outcome.size.seeds
    caption = (
        f"Training curves of the five configurations (figure 6.4 of the thesis), and of the least that it allows: "
        f"means over {seeds} seeds, bands from the least to the largest; {outcome.size.complexity**3} nodes."
    )
    return curves(outcome, caption), dots(outcome, "Errors of all configurations under all protocols.")


EXPERIMENT = Experiment(trials, figures)
