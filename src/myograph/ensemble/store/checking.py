"""Is a store what it says? Every file against its checksum, every array against shape, finiteness and mesh.

The group `cases` is held against the rows once every case has one: it is written at the end of a run.
"""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import zarr

from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import chunk_path, decode
from myograph.ensemble.store.opening import readable_row
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import Row, read_row
from myograph.ensemble.store.summary import summary_problem
from myograph.errors import InputError

UNCOUNTED = ("provenance.json", "card.md", "card.png")
"""Files that say who computed a store, when and at what cost: not part of its checksum."""


@dataclass(frozen=True)
class Problem:
    """What is wrong, and with which case; None for what all cases share.

    Parameters
    ----------
    summed_up
        Whether it is of what every run writes anew at its end.
    """

    case: int | None
    what: str
    summed_up: bool = False


def check_store(store: Path, plan: StorePlan) -> Iterator[Problem]:
    """All problems of a store, those that all cases share first."""
    still = list(_still(store, plan))
    yield from still
    if not still:
        for muscle in plan.muscles:
            yield from _mesh(store, plan, muscle)
    rows = [readable_row(store, case) for case in range(plan.size)]
    what = "" if None in rows else summary_problem(store, plan, rows)
    if what:
        yield Problem(None, what, summed_up=True)
    for case in range(plan.size):
        what = _case(store, plan, case)
        if what:
            yield Problem(case, what)


def _still(store: Path, plan: StorePlan) -> Iterator[Problem]:
    """Files that never change."""
    for name, expected in plan.still.items():
        try:
            damaged = checksum((store / name).read_bytes()) != expected
        except OSError as problem:
            yield Problem(None, f"{name}: cannot be read ({problem.strerror})")
            continue
        if damaged:
            yield Problem(None, f"{name}: its bytes are not those that were written")


def _mesh(store: Path, plan: StorePlan, muscle: str) -> Iterator[Problem]:
    """The reference body: sizes that fit, finite places, corners that exist."""
    group, nodes = zarr.open_group(store / muscle, mode="r"), plan.nodes[muscle]
    reference = np.asarray(group["reference_position"])
    if reference.shape != (nodes, 3) or not np.isfinite(reference).all():
        yield Problem(None, f"{muscle}/reference_position: expected {nodes} finite places, got {reference.shape}")
    for name in ("surface_quads", "connectivity", "sensor_nodes"):
        corners = np.asarray(group[name])
        if corners.size and not 0 <= corners.min() <= corners.max() < nodes:
            yield Problem(None, f"{muscle}/{name}: expected nodes from 0 to {nodes - 1}")


def _case(store: Path, plan: StorePlan, case: int) -> str:
    """What is wrong with a case; empty where nothing is."""
    try:
        row = read_row(store, case)
    except InputError:
        return "its row is damaged"
    if row is None or row.state == "failed":
        return _unanswered(store, plan, case, row)
    expected = {f"{muscle}/{field}" for muscle, field in plan.arrays}
    if set(row.chunks) != expected or not np.isfinite([row.elbow_angle or 0.0, *row.moments.values()]).all():
        return "its row does not fit this store"
    for name, found in row.chunks.items():
        what = _chunk(store, plan, name, case, found)
        if what:
            return what
    return ""


def _unanswered(store: Path, plan: StorePlan, case: int, row: Row | None) -> str:
    """What is wrong with a case that failed, or has no row: the one has no arrays, the other should be computed."""
    left = [f"{muscle}/{field}" for muscle, field in plan.arrays if chunk_path(store, muscle, field, case).exists()]
    arrays = f"has arrays without an answer: {', '.join(left)}" if left else ""
    words = ["has not been computed yet"] if row is None else []
    return ", ".join([*words, arrays] if arrays else words)


def _chunk(store: Path, plan: StorePlan, name: str, case: int, expected: str) -> str:
    muscle, field = name.split("/")
    try:
        data = chunk_path(store, muscle, field, case).read_bytes()
    except FileNotFoundError:
        return f"{name}: its array is missing"
    except OSError as problem:
        return f"{name}: cannot be read ({problem.strerror})"
    if checksum(data) != expected:
        return f"{name}: its {len(data)} bytes are not those that were written"
    try:
        decode(field, data, plan.nodes[muscle])
    except InputError as problem:
        return f"{muscle}/{problem}"
    return ""


def store_checksum(store: Path) -> str:
    """One checksum of all that is computed: every file but those of `UNCOUNTED`."""
    digest = hashlib.blake2b(digest_size=16)
    for path in sorted(path for path in store.rglob("*") if path.is_file()):
        name = path.relative_to(store).as_posix()
        if name.startswith(".") or name in UNCOUNTED:
            continue
        digest.update(f"{name} {checksum(path.read_bytes())}\n".encode())
    return digest.hexdigest()
