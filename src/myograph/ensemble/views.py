"""Cases of a store seen otherwise: some of them under other words, or those of two stores one after the other.

Nothing is copied: fields stay where they lie. A view has a checksum of its own, so that what is learned from it is
never taken for what was learned from the whole.
"""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases, ReadField
from myograph.errors import InputError


def chosen(cases: MuscleCases, words: Mapping[str, Sequence[int]]) -> MuscleCases:
    """The cases of these numbers, under these words, in this order.

    Raises InputError for a number that is no case, and for one that is named twice.
    """
    numbers = np.array([number for listed in words.values() for number in listed], dtype=np.int64)
    if len(np.unique(numbers)) < len(numbers):
        raise InputError("chosen cases: expected every case once, got some under two words; leave out the copies")
    if len(numbers) and not 0 <= numbers.min() <= numbers.max() < len(cases):
        raise InputError(
            f"chosen cases: expected numbers from 0 to {len(cases) - 1}, got {numbers.min()} to {numbers.max()}"
        )
    design = tuple(word for word, listed in words.items() for _ in listed)
    told = f"{cases.checksum} {numbers.tolist()} {design}"
    return replace(
        cases,
        activation=cases.activation[numbers],
        hand_load=cases.hand_load[numbers],
        elbow_angle=cases.elbow_angle[numbers],
        design=design,
        read=_renumbered(cases.read, numbers),
        checksum=hashlib.sha256(told.encode()).hexdigest(),
    )


def joined(first: MuscleCases, second: MuscleCases) -> MuscleCases:
    """The cases of both, one after the other, in the fields that both have.

    Raises InputError for cases of different bodies.
    """
    here, there = first.body.reference, second.body.reference
    if first.muscle != second.muscle or here.shape != there.shape or not np.allclose(here, there):
        raise InputError(
            f"joined cases: expected one body, got {first.muscle} of {first.nodes} nodes and {second.muscle} of "
            f"{second.nodes}, or other meshes; take stores of one preset and one arm"
        )
    return replace(
        first,
        activation=np.concatenate([first.activation, second.activation]),
        hand_load=np.concatenate([first.hand_load, second.hand_load]),
        elbow_angle=np.concatenate([first.elbow_angle, second.elbow_angle]),
        design=first.design + second.design,
        fields=tuple(name for name in first.fields if name in second.fields),
        read=_one_after_the_other(first, second),
        checksum=hashlib.sha256(f"{first.checksum} {second.checksum}".encode()).hexdigest(),
    )


def _renumbered(read: ReadField, numbers: Int[np.ndarray, " cases"]) -> ReadField:
    def read_some(name: str, some: Int[np.ndarray, " some"]) -> Float[np.ndarray, "some nodes ..."]:
        return read(name, numbers[some])

    return read_some


def _one_after_the_other(first: MuscleCases, second: MuscleCases) -> ReadField:
    def read_both(name: str, some: Int[np.ndarray, " some"]) -> Float[np.ndarray, "some nodes ..."]:
        later = some >= len(first)
        parts = first.read(name, some[~later]), second.read(name, some[later] - len(first))
        values = np.empty((len(some), *parts[0].shape[1:]), np.result_type(*parts))
        values[~later], values[later] = parts
        return values

    return read_both
