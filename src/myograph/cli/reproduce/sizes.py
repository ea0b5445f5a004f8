"""How large the reproduction is, by preset."""

import hashlib
import json
from dataclasses import asdict, dataclass

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
    steps, batch
        Training steps of a small graph, and pairs of each; see `training`.
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
    batch: int
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

    def training(self, nodes_per_axis: int) -> dict[str, int]:
        """Settings of a graph's training: fewer steps where a step is dearer."""
        steps = max(10, self.steps * 3 // (3 + max(0, nodes_per_axis - 2)))
        return {"steps": steps, "batch": self.batch}

    @property
    def trained(self) -> str:
        """How long networks are trained, in words."""
        axes = sorted({2, 3, self.complexity, self.large})
        graphs = ", ".join(f"of {axis**3} nodes {self.training(axis)['steps']:,}" for axis in axes)
        return (
            f"graphs {graphs}, each of {self.batch} pairs; in 'meshes' all as many as those of {self.large**3} nodes, "
            f"in 'convolutions' half; in 6.2.4 graphs have {self.complexity**3} nodes; feed-forward network "
            f"{self.benchmark_steps:,}"
        )

    @property
    def checksum(self) -> str:
        """Of all sizes: results of others do not belong into one table with theirs."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:16]


SIZES = {
    "tiny": Size(
        states=50, support=64, off_grid=12, direct_factorial=8, direct_off_grid=4,
        steps=60, batch=8, thesis_steps=120, benchmark_steps=30,
        large=3, complexity=3, seeds=2, pairs=48,
        meshes=(2, 3), sensors=(4, 9), taught=(8, 32), thin=1,
    ),
    "quick": Size(
        states=55, support=512, off_grid=64, direct_factorial=16, direct_off_grid=8,
        steps=1000, batch=4, thesis_steps=3960, benchmark_steps=300,
        large=7, complexity=4, seeds=3, pairs=256,
        meshes=(2, 4, 7), sensors=(3, 5, 9, 18, 36, 72), taught=(8, 16, 32, 64, 128, 256), thin=6,
    ),
    "thesis": Size(
        states=55, support=1743, off_grid=128, direct_factorial=32, direct_off_grid=64,
        steps=3000, batch=8, thesis_steps=3960, benchmark_steps=1000,
        large=7, complexity=7, seeds=3, pairs=512,
        meshes=(2, 3, 4, 5, 7), sensors=(3, 5, 9, 18, 36, 72, 144),
        taught=(8, 16, 32, 64, 128, 256, 512, 1024), thin=6,
    ),
}  # fmt: skip


def reproduction_size(preset: str) -> Size:
    """Size of the preset; raise InputError for an unknown name."""
    if preset not in SIZES:
        raise InputError(f"unknown preset '{preset}': expected one of {', '.join(SIZES)}")
    return SIZES[preset]
