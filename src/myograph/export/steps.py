"""What a file of fields over time holds: one `Step` for each case of a dataset, or each time of a movement."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from myograph.case import Solution
from myograph.ensemble.muscle_cases import MuscleCases


@dataclass(frozen=True)
class Step:
    """One state.

    Parameters
    ----------
    time
        Time [s], or the number of a case.
    fields
        Muscle -> field (see `myograph.fields`) -> values at its nodes; 'position' [mm] is always there.
    numbers
        What belongs to no place: name -> a few numbers, such as the activations.
    """

    time: float
    fields: Mapping[str, Mapping[str, np.ndarray]]
    numbers: Mapping[str, np.ndarray] = field(default_factory=dict)


def steps_of_cases(cases: MuscleCases, times: Sequence[float] | None = None) -> Iterator[Step]:
    """A step for each case of one muscle, read one after the other; without `times` they are numbered from 0."""
    assert times is None or len(times) == len(cases)
    for case in range(len(cases)):
        chosen = np.array([case])
        values = {name: cases.values(name, chosen)[0] for name in cases.fields}
        numbers = {
            "activation": cases.activation[case],
            "hand_load": cases.hand_load[chosen],
            "elbow_angle": cases.elbow_angle[chosen],
        }
        yield Step(float(case if times is None else times[case]), {cases.muscle: values}, numbers)


def steps_of_solutions(times: Iterable[float], solutions: Iterable[Solution]) -> Iterator[Step]:
    """A step for each answer: a movement, or with one time a single prediction."""
    for time, solution in zip(times, solutions, strict=True):
        numbers = {
            "activation": np.array(solution.case.activations),
            "hand_load": np.array([solution.case.hand_load]),
            "elbow_angle": np.array([solution.elbow_angle]),
        }
        yield Step(float(time), solution.fields, numbers)
