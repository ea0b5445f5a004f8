r"""Gappy POD: coefficients of the modes from what a few sensors say.

    T(node) = mean + sum_k c_k φ_k(node),    c = argmin |T(sensors) - measured|² + ε² sum_k (c_k/σ_k)²

σ_k is the spread of c_k over the training cases and ε [mm] what a sensor is trusted to: the ridge keeps modes that the
sensors hardly see near their mean, so that any sensors in any number give an answer. The number of modes and ε are
those with the smallest mean error on every fifth training case, left out of the modes; then all cases make the modes.
Convention: answers at the nodes that it was fitted to, so that both ways to name points give the same.
Sources: Everson & Sirovich 1995; ridge by the spread as in Tikhonov's and the Bayesian reading.
"""

from dataclasses import dataclass
from itertools import product
from typing import final

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.baselines.pod import Pod, pod_of
from myograph.learning.baselines.sensed import sensed_movement
from myograph.learning.baselines.taught import taught_cases

COUNTS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)
TRUSTS = (1e-4, 1e-3, 1e-2, 1e-1, 1.0)
"""Numbers of modes and ε [mm] that are tried."""
LEFT_OUT = 5
"""Every fifth training case chooses between them."""


@final
class GappyPod:
    """The method before it has seen data."""

    name = "gappy_pod"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> "FittedGappyPod":
        """Modes of the training cases, their number and ε chosen for the sampler's sensors."""
        positions = sampler.cases.values("position", taught_cases(split))
        held = np.arange(len(positions)) % LEFT_OUT == LEFT_OUT - 1
        most = pod_of(positions[~held], max(COUNTS))
        counts = sorted({min(count, len(most.modes)) for count in COUNTS})
        tried = {
            (count, trust): _error(_fitted(most, count, trust), positions[held], sampler)
            for count, trust in product(counts, TRUSTS)
        }
        count, trust = min(tried, key=lambda choice: tried[choice])
        return _fitted(pod_of(positions, count), count, trust)


@final
@dataclass(frozen=True)
class FittedGappyPod:
    """Modes of a body's positions.

    Parameters
    ----------
    mean, spread, trust
        Mean position of each node, σ of each mode's coefficient, ε [mm].
    """

    mean: Float[np.ndarray, "nodes 3"]
    modes: Float[np.ndarray, "modes nodes 3"]
    spread: Float[np.ndarray, " modes"]
    trust: float
    name: str = "gappy_pod"
    fields: tuple[str, ...] = ("position",)

    @property
    def parameters(self) -> int:
        """Number of learned numbers."""
        return self.mean.size + self.modes.size + self.spread.size

    def predict(self, question: Question) -> Answer:
        """Positions [mm]; raises InputError for sensors that are not finite, doubled, or no nodes of the body."""
        _, measured = sensed_movement(question, at_least=1)
        nodes = len(self.mean)
        for asked in (question.sensor_nodes, question.query_nodes):
            if len(asked) and not 0 <= asked.min() <= asked.max() < nodes:
                raise InputError(
                    f"gappy_pod: expected the nodes 0 to {nodes - 1} of its body, got {asked.min()} to {asked.max()}"
                )
        coefficients = self.coefficients(question.sensor_nodes, measured)
        at_queries = self.modes[:, question.query_nodes]
        return Answer({"position": self.mean[question.query_nodes] + np.tensordot(coefficients, at_queries, 1)})

    def coefficients(
        self, sensors: Int[np.ndarray, " sensors"], measured: Float[np.ndarray, "batch sensors 3"]
    ) -> Float[np.ndarray, "batch modes"]:
        """Of the modes, in units of their spread inside: the ridge is then the same for all."""
        seen = (self.modes[:, sensors].reshape(len(self.spread), -1) * self.spread[:, None]).T
        told = (measured - self.mean[sensors]).reshape(len(measured), -1)
        matrix = np.concatenate([seen, self.trust * np.eye(len(self.spread))])
        right = np.concatenate([told, np.zeros((len(told), len(self.spread)))], axis=1)
        return np.linalg.lstsq(matrix, right.T, rcond=None)[0].T * self.spread


def _fitted(pod: Pod, count: int, trust: float) -> FittedGappyPod:
    return FittedGappyPod(pod.mean, pod.modes[:count], pod.spread[:count], trust)


def _error(fitted: FittedGappyPod, positions: Float[np.ndarray, "cases nodes 3"], sampler: PairSampler) -> float:
    """Mean distance at the sampler's queries [mm]."""
    coefficients = fitted.coefficients(sampler.sensors, positions[:, sampler.sensors])
    answered = fitted.mean + np.tensordot(coefficients, fitted.modes, 1)
    return float(np.linalg.norm((answered - positions)[:, sampler.queries], axis=-1).mean())
