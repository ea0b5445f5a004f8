"""One muscle in many cases: what learning, evaluation and pictures read. A view: fields stay where they lie.

`myograph.ensemble.store.reading.read_muscle` opens one in a store; `cases_in_memory` makes one of arrays.
"""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.spec import Body
from myograph.errors import InputError

ReadField = Callable[[str, Int[np.ndarray, " cases"]], Float[np.ndarray, "cases nodes ..."]]
"""The values of a field, by its name, in some cases."""


@dataclass(frozen=True)
class MuscleCases:
    """One muscle in all cases that have an answer.

    Parameters
    ----------
    muscle
        Its name.
    body
        Reference body: nodes [mm], skin, elements.
    activation
        Of the five muscles, in the order of `myograph.MUSCLES`.
    hand_load, elbow_angle
        Of every case [N], [rad].
    design
        A word for every case that says where it came from.
    fields
        Names of the fields that are there.
    read
        Reads a field; what it gives back must not be changed.
    checksum
        Of all that learning reads: what is asked, the fields, the body.
    attributes
        Provenance: simulator, preset, arm_checksum, versions.
    """

    muscle: str
    body: Body
    activation: Float[np.ndarray, "cases muscles"]
    hand_load: Float[np.ndarray, " cases"]
    elbow_angle: Float[np.ndarray, " cases"]
    design: tuple[str, ...]
    fields: tuple[str, ...]
    read: ReadField
    checksum: str
    attributes: Mapping[str, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.design)

    @property
    def nodes(self) -> int:
        """Number of nodes of the reference body."""
        return len(self.body.reference)

    def named(self, *words: str) -> Int[np.ndarray, " cases"]:
        """The cases that come from a design of one of these words."""
        return np.flatnonzero(np.isin(self.design, words))

    def values(self, name: str, cases: Int[np.ndarray, " some"]) -> Float[np.ndarray, "some nodes ..."]:
        """A field in some cases; raises InputError for a field or a case that is not there."""
        if name not in self.fields:
            raise InputError(f"{self.muscle}: expected one of the fields {', '.join(self.fields)}, got '{name}'")
        if len(cases) and not 0 <= cases.min() <= cases.max() < len(self):
            raise InputError(
                f"{self.muscle}: expected cases from 0 to {len(self) - 1}, got {cases.min()}–{cases.max()}"
            )
        return self.read(name, cases)


def cases_in_memory(
    muscle: str,
    body: Body,
    activation: Float[np.ndarray, "cases muscles"],
    design: Sequence[str],
    fields: Mapping[str, Float[np.ndarray, "cases nodes ..."]],
    elbow_angle: Float[np.ndarray, " cases"] | None = None,
) -> MuscleCases:
    """Cases of arrays: without load, the elbow's angle where it is known.

    Raises InputError for arrays that do not fit each other, or are not finite.
    """
    cases = len(activation)
    if len(design) != cases:
        raise InputError(f"expected a design word for each of {cases} cases, got {len(design)}")
    for name, values in fields.items():
        if values.shape[:2] != (cases, len(body.reference)):
            raise InputError(f"{name}: expected {cases} cases of {len(body.reference)} nodes, got {values.shape[:2]}")
    arrays = {"activation": activation, "reference_position": body.reference, **fields}
    for name, values in arrays.items():
        if not np.isfinite(values).all():
            raise InputError(f"{name}: expected finite numbers, got NaN or infinity")
    return MuscleCases(
        muscle,
        body,
        activation,
        np.zeros(cases),
        np.full(cases, np.nan) if elbow_angle is None else elbow_angle,
        tuple(design),
        tuple(fields),
        partial(_of_cases, dict(fields)),
        _checksum(arrays, design),
    )


def _of_cases(
    fields: Mapping[str, Float[np.ndarray, "cases nodes ..."]], name: str, chosen: Int[np.ndarray, " some"]
) -> Float[np.ndarray, "some nodes ..."]:
    return fields[name][chosen]


def _checksum(arrays: Mapping[str, np.ndarray], design: Sequence[str]) -> str:
    digest = hashlib.sha256(" ".join(design).encode())
    for name, values in arrays.items():
        digest.update(f"\n{name} {values.shape} ".encode() + np.ascontiguousarray(values, dtype="<f8").tobytes())
    return digest.hexdigest()
