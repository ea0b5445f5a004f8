"""Damage removed: shared files are written again, cases that are damaged lose their row and are computed again.

A case that failed keeps its row and loses only what it has of an answer.
"""

import os
import shutil
import uuid
from collections.abc import Mapping, Sequence
from pathlib import Path

from myograph.ensemble.spec import Body
from myograph.ensemble.store.aside import ASIDE, sweep
from myograph.ensemble.store.checking import Problem
from myograph.ensemble.store.checksum import checksum
from myograph.ensemble.store.chunks import remove_chunks
from myograph.ensemble.store.making import write_still
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import row_path, state_of
from myograph.errors import InputError


def forget_damage(store: Path, plan: StorePlan, problems: Sequence[Problem], bodies: Mapping[str, Body]) -> None:
    """Make the store such that running it again computes what was damaged; only under the store's lock.

    Raises InputError where the shared files cannot be made again as they were.
    """
    sweep(store)
    if any(problem.case is None and not problem.summed_up for problem in problems):
        _restore(store, plan, bodies)
    for case in {problem.case for problem in problems if problem.case is not None}:
        if state_of(store, case) == "failed":
            remove_chunks(store, plan.arrays, case)
        else:
            forget_case(store, plan, case)


def forget_case(store: Path, plan: StorePlan, case: int) -> None:
    """Remove a case's row, then its arrays."""
    row_path(store, case).unlink(missing_ok=True)
    remove_chunks(store, plan.arrays, case)


def _restore(store: Path, plan: StorePlan, bodies: Mapping[str, Body]) -> None:
    aside = store / ASIDE / uuid.uuid4().hex
    write_still(aside, plan, bodies)
    try:
        for name, expected in plan.still.items():
            if checksum((aside / name).read_bytes()) != expected:
                raise InputError(f"{store}/{name}: cannot be made again as it was; run the ensemble into a new store")
            (store / name).parent.mkdir(parents=True, exist_ok=True)
            os.replace(aside / name, store / name)
    finally:
        shutil.rmtree(aside, ignore_errors=True)
