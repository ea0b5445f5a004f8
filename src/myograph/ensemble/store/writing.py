"""The answer to a case goes to the store: its arrays first, then its row."""

from pathlib import Path

import numpy as np

from myograph.case import Solution
from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.ensemble.store.aside import place
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import chunk_path, encode
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import Row, write_failure, write_row
from myograph.errors import InputError


def write_solution(store: Path, plan: StorePlan, case: int, solution: Solution) -> Row:
    """Store the answer; one that is not complete or not finite becomes a failed row. Raises OSError without room."""
    try:
        numbers = [solution.elbow_angle, *solution.moments.values()]
        if not np.isfinite(numbers).all():
            raise InputError(f"angle and moments: expected finite numbers, got {numbers}")
        encoded = {f"{muscle}/{field}": _chunk(plan, solution, muscle, field) for muscle in plan.muscles
                   for field in NODE_FIELDS}  # fmt: skip
    except Exception as problem:
        return write_failure(store, case, problem)
    for name, data in encoded.items():
        muscle, field = name.split("/")
        place(store, chunk_path(store, muscle, field, case), data)
    row = Row(
        case,
        "done",
        float(solution.elbow_angle),
        {name: float(moment) for name, moment in solution.moments.items()},
        solution.notes,
        chunks={name: checksum(data) for name, data in encoded.items()},
    )
    write_row(store, row)
    return row


def _chunk(plan: StorePlan, solution: Solution, muscle: str, field: str) -> bytes:
    try:
        values = solution.fields[muscle][field]
    except KeyError:
        raise InputError(f"{muscle}: expected the field '{field}', got none") from None
    try:
        return encode(field, np.asarray(values), plan.nodes[muscle])
    except InputError as problem:
        raise InputError(f"{muscle}: {problem}") from None
