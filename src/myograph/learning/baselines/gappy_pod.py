r"""Gappy POD: coefficients of the modes from what a few sensors say.

    T(node) = mean + sum_k c_k φ_k(node),    c = argmin |T(sensors) - measured|² + ε² sum_k (c_k/σ_k)²

σ_k is the spread of c_k over the training cases and ε [mm] what a sensor is trusted to: the ridge keeps modes that the
sensors hardly see near their mean, so that any sensors in any number give an answer. The number of modes and ε are
those with the smallest mean error on every fifth training case, left out of the modes; then all cases make the modes.
Convention: answers at the nodes that it was fitted to; both ways to name points give the same.
Sources: Everson & Sirovich 1995; ridge by the spread as in Tikhonov's and the Bayesian reading.
"""

from dataclasses import dataclass
from itertools import product
from typing import final

import numpy as np
import torch
from jaxtyping import Float

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.signature import Signature
from myograph.learning.baselines.gappy_module import GappyPodModule, GappyPodShape
from myograph.learning.baselines.pod import Pod, pod_of
from myograph.learning.baselines.taught import taught_cases
from myograph.learning.threads import on_one_thread
from myograph.learning.torch_predictor import TorchPredictor

COUNTS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)
TRUSTS = (1e-4, 1e-3, 1e-2, 1e-1, 1.0)
"""Numbers of modes and ε [mm] that are tried."""
LEFT_OUT = 5
"""Every fifth training case chooses between them."""


@final
class GappyPod:
    """The method before it has seen data."""

    name = "gappy_pod"

    @on_one_thread
    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Modes of the training cases, their number and ε chosen for the sampler's sensors."""
        positions = sampler.cases.values("position", taught_cases(split))
        held = np.arange(len(positions)) % LEFT_OUT == LEFT_OUT - 1
        most = pod_of(positions[~held], max(COUNTS))
        counts = sorted({min(count, len(most.modes)) for count in COUNTS})
        tried = {
            (count, trust): Tried(most, count, trust).error(positions[held], sampler)
            for count, trust in product(counts, TRUSTS)
        }
        count, trust = min(tried, key=lambda choice: tried[choice])
        return _predictor(pod_of(positions, count), trust, sampler)


@dataclass(frozen=True)
class Tried:
    """Some modes and ε [mm]."""

    pod: Pod
    count: int
    trust: float

    def error(self, positions: Float[np.ndarray, "cases nodes 3"], sampler: PairSampler) -> float:
        """Mean distance at the sampler's queries, from its sensors [mm]."""
        pod, some = self.pod, slice(self.count)
        seen = (pod.modes[some, sampler.sensors].reshape(self.count, -1) * pod.spread[some, None]).T
        told = (positions - pod.mean)[:, sampler.sensors].reshape(len(positions), -1)
        matrix = np.concatenate([seen, self.trust * np.eye(self.count)])
        right = np.concatenate([told, np.zeros((len(told), self.count))], axis=1)
        amounts = np.linalg.lstsq(matrix, right.T, rcond=None)[0].T * pod.spread[some]
        answered = pod.mean + np.tensordot(amounts, pod.modes[some], 1)
        return float(np.linalg.norm((answered - positions)[:, sampler.queries], axis=-1).mean())


def _predictor(pod: Pod, trust: float, sampler: PairSampler) -> TorchPredictor:
    shape = GappyPodShape(kept_modes=len(pod.modes), body_nodes=sampler.cases.nodes, trust=trust)
    module = GappyPodModule(shape)
    learned = {"mean": pod.mean, "modes": pod.modes, "spread": pod.spread}
    module.load_state_dict({name: torch.from_numpy(np.asarray(values, np.float64)) for name, values in learned.items()})
    signature = Signature(
        inputs=("sensor_nodes", "sensor_position_target", "query_nodes"),
        outputs=("position",),
        convention=sampler.convention,
        sensors=tuple(sampler.sensors.tolist()),
        any_sensors=True,
    )
    return TorchPredictor(GappyPod.name, "gappy_pod", module.eval(), signature, shape)
