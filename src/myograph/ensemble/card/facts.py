"""What there is to say about a store, in numbers."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from myograph.ensemble.card.ranges import MuscleScalars, Range, muscle_scalars, ranges
from myograph.ensemble.store.chunks import case_shape, chunk_path
from myograph.ensemble.store.opening import readable_row
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.provenance import provenance

SHORT = ("displacement", "von_mises")
"""What a card tells of a muscle: reading these two takes a third of the time that all fields take."""


@dataclass(frozen=True)
class StoreFacts:
    """What a store holds.

    Parameters
    ----------
    plan
        What is asked.
    done, failed, missing
        Numbers of cases.
    reasons
        Why cases failed, and how many of each.
    designs
        Word -> number of cases.
    angle
        Elbow flexion of the cases that are done [rad]; None where there is none.
    fields
        Muscle -> scalar field -> its range over nodes and cases.
    unreadable
        Chunks that could not be read.
    stored, raw
        Bytes of all chunks, on disk and in memory.
    provenance
        Versions, command, seconds.
    """

    plan: StorePlan
    done: int
    failed: int
    missing: int
    reasons: Mapping[str, int]
    designs: Mapping[str, int]
    angle: Range | None
    fields: Mapping[str, Mapping[str, Range]]
    unreadable: int
    stored: int
    raw: int
    provenance: Mapping[str, str]


def gather_facts(store: Path, names: tuple[str, ...] | None = SHORT) -> StoreFacts:
    """The facts of a store; ranges of some fields, or with None of all that are scalar. It reads those fields."""
    plan = read_plan(store)
    rows = [readable_row(store, case) for case in range(plan.size)]
    done = [row.case for row in rows if row is not None and row.state == "done"]
    failed = [row.reason for row in rows if row is not None and row.state == "failed"]
    found = {muscle: _ranges(muscle_scalars(store, plan, muscle), done, names) for muscle in plan.muscles}
    angles = [row.elbow_angle for row in rows if row is not None and row.elbow_angle is not None]
    return StoreFacts(
        plan,
        len(done),
        len(failed),
        plan.size - len(done) - len(failed),
        dict(Counter(failed).most_common()),
        dict(Counter(plan.design.words)),
        Range(min(angles), float(np.mean(angles)), max(angles)) if angles else None,
        {muscle: fields for muscle, (fields, _) in found.items()},
        sum(unreadable for _, unreadable in found.values()),
        _stored(store, plan, done),
        sum(4 * int(np.prod(case_shape(field, plan.nodes[muscle]))) for muscle, field in plan.arrays) * len(done),
        provenance(store),
    )


def _ranges(scalars: MuscleScalars, done: list[int], names: tuple[str, ...] | None) -> tuple[Mapping[str, Range], int]:
    return ranges(scalars, done, [name for name in scalars.names if names is None or name in names])


def _stored(store: Path, plan: StorePlan, done: list[int]) -> int:
    places = (chunk_path(store, *array, case) for array in plan.arrays for case in done)
    return sum(place.stat().st_size for place in places if place.exists())
