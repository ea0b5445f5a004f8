"""Questions about any pairs of the cases of one muscle, read from where these lie.

    D_inp   what is known at a few nodes, the sensors: the same nodes for all pairs
    D_out   all other nodes, the queries

Source: thesis section 5.2.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.question import Batch, Convention, FieldValues, Question, check_convention
from myograph.errors import InputError

SENSORS, SENSOR_SEED = 9, 0
"""The standard sensors: nine nodes at random, as in the thesis."""


@dataclass(frozen=True)
class PairSampler:
    """Asks about pairs.

    Raises InputError for sensors that are none of the nodes, or doubled, and for unknown conventions and fields.

    Parameters
    ----------
    cases
        Where fields are read.
    sensors
        Nodes whose state is known.
    convention
        How points are named.
    known, asked
        Fields that sensors tell, fields that are asked.
    queries
        All nodes that are no sensors.
    """

    cases: MuscleCases
    sensors: Int[np.ndarray, " sensors"]
    convention: Convention = "initial"
    known: tuple[str, ...] = ("position",)
    asked: tuple[str, ...] = ("position",)
    queries: Int[np.ndarray, " queries"] = field(init=False)

    def __post_init__(self) -> None:
        check_sensors(self.sensors, self.cases.nodes)
        check_convention(self.convention)
        for name in (*self.known, *self.asked):
            if name not in self.cases.fields:
                raise InputError(f"expected one of the fields {', '.join(self.cases.fields)}, got '{name}'")
        object.__setattr__(self, "queries", np.setdiff1d(np.arange(self.cases.nodes), self.sensors))

    def batch(self, pairs: Int[np.ndarray, "batch 2"], queries: Int[np.ndarray, " asked"] | None = None) -> Batch:
        """Questions about the pairs and the answers, at all queries or at those nodes named in `queries`."""
        where = self.queries if queries is None else queries
        initial, target = pairs[:, 0], pairs[:, 1]
        known, asked = {*self.known, "position"}, {*self.asked, "position"}
        before = {name: self.cases.values(name, initial) for name in known | asked}
        after = {name: self.cases.values(name, target) for name in known | set(self.asked)}
        question = Question(
            self.convention,
            self.cases.activation[target],
            self.cases.hand_load[target],
            self.sensors,
            where,
            self._places(before["position"], self.sensors),
            self._places(before["position"], where),
            _at(before, known, self.sensors),
            _at(after, known, self.sensors),
            _at(before, asked, where),
        )
        return Batch(question, _at(after, set(self.asked), where))

    def batches(self, pairs: Int[np.ndarray, "pairs 2"], size: int = 32) -> Iterator[Batch]:
        """All pairs at all queries, some at once."""
        for first in range(0, len(pairs), size):
            yield self.batch(pairs[first : first + size])

    def _places(self, initial: Float[np.ndarray, "batch nodes 3"], nodes: Int[np.ndarray, " some"]) -> np.ndarray:
        if self.convention == "initial":
            return initial[:, nodes]
        return np.broadcast_to(self.cases.body.reference[nodes], (len(initial), len(nodes), 3))


def random_sensors(nodes: int, count: int = SENSORS, seed: int = SENSOR_SEED) -> Int[np.ndarray, " sensors"]:
    """That many nodes at random; raises InputError unless that leaves something to ask."""
    if not 1 <= count < nodes:
        raise InputError(f"expected between 1 and {nodes - 1} sensors on {nodes} nodes, got {count}")
    return np.sort(np.random.default_rng(seed).permutation(nodes)[:count])


def listed_sensors(listed: Sequence[int], nodes: int) -> Int[np.ndarray, " sensors"]:
    """These nodes; raises InputError for one that the body does not have, or has twice."""
    sensors = np.array(listed, dtype=np.int64)
    check_sensors(sensors, nodes)
    return sensors


def check_sensors(sensors: Int[np.ndarray, " sensors"], nodes: int) -> None:
    """Raise InputError unless these are different nodes of a body and leave some to ask."""
    if not 1 <= len(sensors) < nodes or not 0 <= sensors.min() <= sensors.max() < nodes:
        found = sensors.tolist() or "none"
        raise InputError(f"sensors: expected 1 to {nodes - 1} of the nodes 0 to {nodes - 1}, got {found}")
    if len(np.unique(sensors)) < len(sensors):
        raise InputError(f"sensors: expected every node once, got {sensors.tolist()}; leave out the copies")


def _at(fields: FieldValues, names: set[str], nodes: Int[np.ndarray, " some"]) -> dict[str, np.ndarray]:
    return {name: fields[name][:, nodes] for name in sorted(names)}
