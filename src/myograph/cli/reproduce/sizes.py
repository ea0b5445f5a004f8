"""How large the reproduction is, by preset."""

from dataclasses import dataclass

from myograph.errors import InputError

PRESETS = ("tiny", "quick", "thesis")


@dataclass(frozen=True)
class Size:
    """Size of one reproduction.

    Parameters
    ----------
    states
        Most states in the table of each muscle.
    support, off_grid
        Further training cases, and cases with continuous activations to test on.
    direct_factorial, direct_off_grid
        Cases that are solved by finite elements, each of them.
    steps
        Training steps of a small graph; `share` says what larger ones get.
    thesis_steps, benchmark_steps
        Steps at the thesis's own rates, 990 epochs of 4; and of the feed-forward benchmark, whose steps are dear.
    large, complexity
        Nodes per axis of the larger graph, and of the graph of section 6.2.4.
    seeds
        Where a spread is shown.
    pairs
        Test pairs of a protocol, at most.
    meshes, sensors, taught
        Nodes per axis, numbers of sensors, and numbers of simulations that are compared.
    thin
        Thin models of each kind, at most.
    """

    states: int
    support: int
    off_grid: int
    direct_factorial: int
    direct_off_grid: int
    steps: int
    thesis_steps: int
    benchmark_steps: int
    large: int
    complexity: int
    seeds: int
    pairs: int
    meshes: tuple[int, ...]
    sensors: tuple[int, ...]
    taught: tuple[int, ...]
    thin: int

    def share(self, nodes_per_axis: int) -> int:
        """Training steps of a graph: fewer where a step is dearer."""
        return max(10, self.steps * 3 // (3 + max(0, nodes_per_axis - 2)))


SIZES = {
    "tiny": Size(50, 64, 12, 8, 4, 60, 120, 30, 3, 3, 2, 48, (2, 3), (4, 9), (8, 32), 1),
    "quick": Size(
        55, 512, 64, 16, 8, 600, 3960, 300, 7, 4, 3, 256, (2, 4, 7), (3, 5, 9, 18, 36, 72),
        (8, 16, 32, 64, 128, 256), 6,
    ),
    "thesis": Size(
        55, 1743, 128, 32, 64, 3000, 3960, 1000, 7, 7, 3, 512, (2, 3, 4, 5, 7), (3, 5, 9, 18, 36, 72, 144),
        (8, 16, 32, 64, 128, 256, 512, 1024), 6,
    ),
}  # fmt: skip


def reproduction_size(preset: str) -> Size:
    """Size of the preset; raise InputError for an unknown name."""
    if preset not in SIZES:
        raise InputError(f"unknown preset '{preset}': expected one of {', '.join(SIZES)}")
    return SIZES[preset]
