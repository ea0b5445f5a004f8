"""Input and query samples of pairs of cases: what a network reads and what it is asked.

A pair is (initial case, target case); a node sits at S in the initial case and at T in the target case.

    D_inp   features (S, T) at a few fixed nodes, the sensors: random, the same for all pairs
    D_out   at all other nodes, the queries: asked at S, answered with T

Convention: queries are named by their position S in the initial state ('initial'), as in the thesis; material
coordinates X would name the tissue itself. Source: thesis equations 2.5-2.7 and section 5.2.
"""

import hashlib
from dataclasses import dataclass

import numpy as np
import xarray as xr
from jaxtyping import Float, Int

from myograph.errors import InputError


@dataclass(frozen=True)
class Batch:
    """Samples of some pairs [mm]: (S, T) at the sensors, S and T at the queries."""

    sensors: Float[np.ndarray, "batch sensors 6"]
    queries: Float[np.ndarray, "batch queries 3"]
    targets: Float[np.ndarray, "batch queries 3"]


@dataclass(frozen=True)
class Source:
    """Where positions come from: the muscle, and the checksum of its dataset."""

    muscle: str
    checksum: str


@dataclass(frozen=True)
class PairSampler:
    """Reads the samples of any pairs from a dataset's positions.

    Parameters
    ----------
    positions
        Of all nodes in all cases [mm]; the dataset's own array, not a copy.
    sensors
        Indices of the nodes whose movement is known.
    queries
        Indices of all other nodes.
    source
        Which dataset this is.
    """

    positions: Float[np.ndarray, "cases nodes 3"]
    sensors: Int[np.ndarray, " sensors"]
    queries: Int[np.ndarray, " queries"]
    source: Source

    def batch(self, pairs: Int[np.ndarray, "batch 2"], queries: Int[np.ndarray, " asked"] | None = None) -> Batch:
        """Samples of the pairs, at all queries or at those nodes named in `queries`."""
        asked = self.queries if queries is None else queries
        initial, target = pairs[:, 0, None], pairs[:, 1, None]
        sensors = [self.positions[initial, self.sensors], self.positions[target, self.sensors]]
        return Batch(np.concatenate(sensors, axis=-1), self.positions[initial, asked], self.positions[target, asked])


def sample_pairs(dataset: xr.Dataset, sensors: int = 9, seed: int = 0) -> PairSampler:
    """Choose that many sensors at random among the nodes of a dataset; the rest are queries."""
    positions = dataset["position"].values
    nodes = positions.shape[1]
    if not 1 <= sensors < nodes:
        raise InputError(f"expected between 1 and {nodes - 1} sensors on {nodes} nodes, got {sensors}")
    if not np.isfinite(positions).all():
        raise InputError("positions of the dataset: expected finite numbers, got NaN or infinity; check the dataset")
    shuffled = np.random.default_rng(seed).permutation(nodes)
    source = Source(dataset.attrs["muscle"], dataset_checksum(dataset))
    return PairSampler(positions, np.sort(shuffled[:sensors]), np.sort(shuffled[sensors:]), source)


def dataset_checksum(dataset: xr.Dataset) -> str:
    """SHA-256 of what learning reads: activations, designs and positions."""
    digest = hashlib.sha256()
    for name in ("activation", "design", "position"):
        digest.update(np.ascontiguousarray(dataset[name].values).tobytes())
    return digest.hexdigest()
