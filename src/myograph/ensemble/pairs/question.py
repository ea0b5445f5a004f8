"""What a method is told about pairs of cases and asked; what it answers; what is right.

A pair is (initial case, target case). A node sits at X in the reference body, at S in the initial and at T in the
target case. Points are named by X in the convention 'material', which names a piece of tissue for ever, or by S in the
convention 'initial', as in the thesis. Source: thesis equations 2.5-2.7.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np
from jaxtyping import Bool, Float, Int

from myograph.errors import InputError

Convention = Literal["initial", "material"]
CONVENTIONS: tuple[Convention, ...] = get_args(Convention)
FieldValues = Mapping[str, Float[np.ndarray, "batch _ ..."]]
"""Field -> values at some points of some pairs."""
Widths = Mapping[str, Float[np.ndarray, "batch queries"]]
"""Field -> a length or stress for each value that is answered."""


def check_convention(name: str) -> None:
    """Raise InputError for a name that is none of the conventions."""
    if name not in CONVENTIONS:
        raise InputError(f"convention: expected one of {', '.join(CONVENTIONS)}, got '{name}'")


@dataclass(frozen=True)
class Question:
    """What is known about the target cases of some pairs, and where they are asked. A method reads what it needs.

    Parameters
    ----------
    convention
        How points are named.
    activation, hand_load
        Of the target cases [-], [N].
    sensor_nodes, query_nodes
        Which nodes of the body are sensors and queries.
    sensor_places, query_places
        X or S by the convention [mm].
    sensor_initial, sensor_target
        Fields at the sensors in the initial and in the target case; 'position' always.
    query_initial
        Fields at the queries in the initial case; 'position' always.
    """

    convention: Convention
    activation: Float[np.ndarray, "batch muscles"]
    hand_load: Float[np.ndarray, " batch"]
    sensor_nodes: Int[np.ndarray, " sensors"]
    query_nodes: Int[np.ndarray, " queries"]
    sensor_places: Float[np.ndarray, "batch sensors 3"]
    query_places: Float[np.ndarray, "batch queries 3"]
    sensor_initial: FieldValues
    sensor_target: FieldValues
    query_initial: FieldValues

    @property
    def size(self) -> int:
        """Number of pairs."""
        return len(self.activation)


@dataclass(frozen=True)
class Answer:
    """What a method answers.

    Parameters
    ----------
    values
        Field -> values at the queries in the target case.
    deviation, half_width_90
        Field -> standard deviation, and half width of the 90 % interval, of each error, where the method knows them: of
        the distance [mm] for 'position', of the absolute error [MPa] for 'von_mises'.
    inside
        Whether each target lies within what the method was trained on, where it knows.
    """

    values: FieldValues
    deviation: Widths = field(default_factory=dict)
    half_width_90: Widths = field(default_factory=dict)
    inside: Bool[np.ndarray, " batch"] | None = None


@dataclass(frozen=True)
class Batch:
    """A question and the right answer: field -> values at the queries in the target case."""

    question: Question
    truth: FieldValues
