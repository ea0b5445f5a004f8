"""What a method must not see, hidden: whoever learns from it all the same is found out.

A method that learns from hidden cases fails, or learns NaN; one that does not learns the same, bit for bit.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases, ReadField


def seen_only(cases: MuscleCases, seen: Int[np.ndarray, " seen"]) -> MuscleCases:
    """The cases with NaN for all that was asked and answered in any but the seen ones."""
    hidden = np.ones(len(cases), dtype=bool)
    hidden[seen] = False
    return replace(
        cases,
        activation=np.where(hidden[:, None], np.nan, cases.activation),
        hand_load=np.where(hidden, np.nan, cases.hand_load),
        elbow_angle=np.where(hidden, np.nan, cases.elbow_angle),
        read=_reader(cases.read, hidden),
    )


def _reader(read: ReadField, hidden: np.ndarray) -> ReadField:
    def read_seen(name: str, chosen: Int[np.ndarray, " some"]) -> Float[np.ndarray, "some nodes ..."]:
        values = read(name, chosen).copy()
        values[hidden[chosen]] = np.nan
        return values

    return read_seen
