"""How large the demo's parts are, by preset."""

from dataclasses import dataclass

from myograph.errors import InputError


@dataclass(frozen=True)
class DemoSize:
    """Size of one demo.

    Parameters
    ----------
    states
        Most states in the table of each muscle.
    off_grid
        Cases with continuous activations.
    steps
        Training steps of the small and of the large network, by nodes per axis.
    """

    states: int
    off_grid: int
    steps: dict[int, int]


SENSORS = 9
SEED = 0
MUSCLE = "biceps"
SIZES = {
    "tiny": DemoSize(states=50, off_grid=12, steps={2: 500, 7: 300}),
    "quick": DemoSize(states=55, off_grid=24, steps={2: 6000, 7: 2500}),
    "thesis": DemoSize(states=55, off_grid=32, steps={2: 12000, 7: 8000}),
}


def demo_size(preset: str) -> DemoSize:
    """Size of the preset; raise InputError for an unknown name."""
    if preset not in SIZES:
        raise InputError(f"unknown preset '{preset}': expected one of {', '.join(SIZES)}")
    return SIZES[preset]
