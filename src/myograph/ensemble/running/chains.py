r"""Which cases go together, and what has to be solved for those that are missing.

A simulator that remembers is asked for neighbours one after the other, in chains of fixed length, and forgets between
chains and after a failed case. So an answer depends on nothing but the cases before it in its chain: the bytes are the
same however many workers there are, and after a kill too. The price: what is missing at the end of a chain needs the
chain solved again up to there, without storing.

Chains follow the nearest neighbour in (activations, load and angle scaled to their ranges), from case 0 on.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from myograph.case import Case
from myograph.ensemble.store.rows import State

CHAIN, BATCH = 8, 24
"""Cases that are solved together: with and without memory."""


@dataclass(frozen=True)
class Step:
    """One case to solve: whether its answer is stored, whether the simulator forgets before."""

    case: int
    write: bool
    fresh: bool


def batches(cases: Sequence[Case], remembers: bool) -> list[tuple[int, ...]]:
    """All cases in groups of neighbours; they depend on the cases alone."""
    order, size = (_by_neighbour(cases), CHAIN) if remembers else (list(range(len(cases))), BATCH)
    return [tuple(order[k : k + size]) for k in range(0, len(order), size)]


def steps(batch: Sequence[int], state_of: Callable[[int], State | None], remembers: bool) -> list[Step]:
    """What to solve such that every case of a batch has an answer."""
    states = [state_of(case) for case in batch]
    if not remembers:
        return [Step(case, True, False) for case, state in zip(batch, states, strict=True) if state is None]
    found: list[Step] = []
    run: list[Step] = []
    for case, state in zip(batch, states, strict=True):
        if state == "failed":
            found, run = found + _up_to_missing(run), []
        else:
            run.append(Step(case, state is None, fresh=not run))
    return found + _up_to_missing(run)


def _up_to_missing(run: list[Step]) -> list[Step]:
    last = max((k for k, step in enumerate(run) if step.write), default=-1)
    return run[: last + 1]


def _by_neighbour(cases: Sequence[Case]) -> list[int]:
    left, places = np.arange(len(cases)), _places(cases)
    order = [0]
    left = np.delete(left, 0)
    while len(left):
        nearest = int(np.argmin(np.abs(places[left] - places[order[-1]]).sum(axis=1)))
        order.append(int(left[nearest]))
        left = np.delete(left, nearest)
    return order


def _places(cases: Sequence[Case]) -> np.ndarray:
    """Activations, and load and angle scaled to [0, 1]."""
    further = np.array([[case.hand_load, case.elbow_angle or 0.0] for case in cases])
    span = np.ptp(further, axis=0)
    return np.hstack([np.array([case.activations for case in cases]), further / np.where(span > 0, span, 1.0)])
