"""The cases of a store as a view that streams: fields are decoded when they are asked for, the latest are kept.

Only cases that have an answer are in the view. Every file is held against its checksum when it is read.
"""

import hashlib
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.spec import Body
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import case_shape, read_chunk
from myograph.ensemble.store.opening import readable_row
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.provenance import provenance
from myograph.ensemble.store.rows import Row
from myograph.errors import InputError

KEPT_BYTES = 256 * 2**20
"""Decoded fields that are kept in memory, at most."""
_BODY = ("reference_position", "surface_quads", "connectivity")


def read_muscle(store: Path, muscle: str, kept_bytes: int = KEPT_BYTES) -> MuscleCases:
    """The answered cases of one muscle; at most `kept_bytes` of decoded fields stay in memory, one case at least.

    Raises InputError where there is no store, a damaged one, one without this muscle, or without any answer; and
    later, when a field is read, where its bytes are not those that were written.
    """
    return read_numbered(store, muscle, kept_bytes)[0]


def read_numbered(store: Path, muscle: str, kept_bytes: int = KEPT_BYTES) -> tuple[MuscleCases, list[int]]:
    """What `read_muscle` gives, and the number that each of these cases has in the store."""
    plan = read_plan(store)
    if muscle not in plan.muscles:
        raise InputError(f"{store}: expected one of {', '.join(plan.muscles)}, got '{muscle}'")
    rows = [row for case in range(plan.size) if (row := readable_row(store, case)) and row.state == "done"]
    if not rows:
        raise InputError(f"{store}: expected answered cases, found none; run it with 'myograph ensemble run'")
    cases = [plan.design.cases[row.case] for row in rows]
    chunks = _Chunks(store, muscle, plan, rows, kept_bytes)
    found = MuscleCases(
        muscle,
        read_body(store, plan, muscle),
        np.array([case.activations for case in cases]),
        np.array([case.hand_load for case in cases]),
        np.array([np.nan if row.elbow_angle is None else row.elbow_angle for row in rows]),
        tuple(plan.design.words[row.case] for row in rows),
        plan.fields,
        chunks.read,
        chunks.identity(plan.identity),
        {"simulator": plan.simulator.kind, **provenance(store), **_told(plan.described)},
    )
    return found, [row.case for row in rows]


def _told(described: Mapping[str, Any]) -> dict[str, str]:
    return {key: str(described[key]) for key in ("preset", "arm_checksum") if key in described}


def read_body(store: Path, plan: StorePlan, muscle: str) -> Body:
    """The reference body of a muscle; raises InputError where a file of it is not what was written."""
    for name, written in plan.still.items():
        if name.startswith(f"{muscle}/") and _bytes(store, store / name, name) != written:
            raise InputError(f"{store}: {name}: not the bytes that were written; {_repair(store)}")
    group = zarr.open_group(store / muscle, mode="r")
    return Body(*(np.asarray(group[name]) for name in _BODY))


def _bytes(store: Path, path: Path, name: str) -> str:
    try:
        return checksum(path.read_bytes())
    except OSError as problem:
        raise InputError(f"{store}: {name}: {problem.strerror}; {_repair(store)}") from None


def _repair(store: Path) -> str:
    return f"run 'myograph ensemble check {store} --repair'"


class _Chunks:
    """Fields of the answered cases of a muscle; the latest ones read are kept."""

    def __init__(self, store: Path, muscle: str, plan: StorePlan, rows: list[Row], most: int) -> None:
        self._store, self._muscle, self._nodes, self._most = store, muscle, plan.nodes[muscle], most
        self._numbers = [row.case for row in rows]
        self._checksums = [{field: row.chunks.get(f"{muscle}/{field}", "") for field in plan.fields} for row in rows]
        self._kept: OrderedDict[tuple[str, int], np.ndarray] = OrderedDict()
        self._bytes = 0

    def __getstate__(self) -> dict[str, Any]:
        """What travels to another process: not what is kept."""
        return {**self.__dict__, "_kept": OrderedDict(), "_bytes": 0}

    def identity(self, plan: str) -> str:
        """One checksum of what is asked and of all fields of this muscle."""
        digest = hashlib.sha256(plan.encode())
        for number, found in zip(self._numbers, self._checksums, strict=True):
            digest.update(f"{number} {' '.join(found.values())}\n".encode())
        return digest.hexdigest()

    def read(self, field: str, cases: Int[np.ndarray, " some"]) -> Float[np.ndarray, "some nodes ..."]:
        """A field in some cases, float32."""
        values = np.empty((len(cases), *case_shape(field, self._nodes)), np.float32)
        for place, case in zip(values, cases.tolist(), strict=True):
            place[:] = self._case(field, case)
        return values

    def _case(self, field: str, case: int) -> np.ndarray:
        key = (field, case)
        if key in self._kept:
            self._kept.move_to_end(key)
            return self._kept[key]
        name = f"{self._muscle}/{field}"
        values = read_chunk(self._store, name, self._numbers[case], self._checksums[case][field], self._nodes)
        self._kept[key] = values
        self._bytes += values.nbytes
        while self._bytes > self._most and len(self._kept) > 1:
            self._bytes -= self._kept.popitem(last=False)[1].nbytes
        return values
