"""The answer to a case goes to the store: its arrays first, then its row; of a failed case nothing but the row."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from myograph.case import Solution
from myograph.ensemble.store.aside import place
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import chunk_path, encode, remove_chunks
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import Row, write_row
from myograph.errors import InputError, NotConvergedError

Fields = Mapping[str, Mapping[str, np.ndarray]]
"""Muscle -> field -> values at its nodes."""


def write_solution(store: Path, plan: StorePlan, case: int, solution: Solution) -> Row:
    """Store the answer; one that is not complete or not finite becomes a failed row. Raises OSError without room."""
    try:
        numbers = [solution.elbow_angle, *solution.moments.values()]
        if not np.isfinite(numbers).all():
            raise InputError(f"angle and moments: expected finite numbers, got {numbers}")
        encoded = _encoded(plan, solution.fields)
    except Exception as problem:
        return write_failure(store, plan, case, problem)
    moments = {name: float(moment) for name, moment in solution.moments.items()}
    return _write(store, encoded, Row(case, "done", float(solution.elbow_angle), moments, solution.notes))


def write_answer(store: Path, plan: StorePlan, case: int, fields: Fields, elbow_angle: float | None) -> Row:
    """Store fields whose moments are not known, nor perhaps the angle; raises InputError where they do not fit."""
    return _write(store, _encoded(plan, fields), Row(case, "done", elbow_angle))


def write_failure(store: Path, plan: StorePlan, case: int, problem: Exception) -> Row:
    """Store why there is no answer, after what there is of one is removed; raises OSError without room."""
    expected = isinstance(problem, InputError | NotConvergedError)
    reason = str(problem) if expected else f"{type(problem).__name__}: {problem}"
    residuals = problem.residuals if isinstance(problem, NotConvergedError) else ()
    row = Row(case, "failed", reason=reason, residuals=tuple(map(float, residuals)))
    remove_chunks(store, plan.arrays, case)
    write_row(store, row)
    return row


def _write(store: Path, encoded: Mapping[str, bytes], row: Row) -> Row:
    """The chunks, then the row that vouches for them."""
    for name, data in encoded.items():
        muscle, field = name.split("/")
        place(store, chunk_path(store, muscle, field, row.case), data)
    row = replace(row, chunks={name: checksum(data) for name, data in encoded.items()})
    write_row(store, row)
    return row


def _encoded(plan: StorePlan, fields: Fields) -> dict[str, bytes]:
    return {f"{muscle}/{field}": _chunk(plan, fields, muscle, field) for muscle, field in plan.arrays}


def _chunk(plan: StorePlan, fields: Fields, muscle: str, field: str) -> bytes:
    try:
        values = fields[muscle][field]
    except KeyError:
        raise InputError(f"{muscle}: expected the field '{field}', got none") from None
    try:
        return encode(field, np.asarray(values), plan.nodes[muscle])
    except InputError as problem:
        raise InputError(f"{muscle}: {problem}") from None
