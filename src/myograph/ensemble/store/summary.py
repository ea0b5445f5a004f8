"""The group `cases` of a store: all numbers of all cases in one place, for readers that know Zarr only.

It repeats what the rows say and is written anew at the end of every run.
"""

import os
import shutil
import uuid
from pathlib import Path

import xarray as xr

from myograph.ensemble.store.aside import ASIDE
from myograph.ensemble.store.opening import cases_dataset
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import Row, read_row

CASES = "cases"


def write_summary(store: Path, plan: StorePlan) -> None:
    """Write the group in place of an older one; raises OSError without room."""
    dataset = cases_dataset(plan, [read_row(store, case) for case in range(plan.size)])
    aside, old = (store / ASIDE / uuid.uuid4().hex for _ in range(2))
    try:
        dataset.to_zarr(aside, mode="w", consolidated=False, zarr_format=3)
        if (store / CASES).exists():
            os.replace(store / CASES, old)
        os.replace(aside, store / CASES)
    finally:
        for left in (aside, old):
            shutil.rmtree(left, ignore_errors=True)


def summary_problem(store: Path, plan: StorePlan, rows: list[Row | None]) -> str:
    """Why the group does not say what the rows say; empty where it does."""
    try:
        with xr.open_zarr(store, group=CASES, consolidated=False, chunks=None) as found:
            same = found.load().identical(cases_dataset(plan, rows))
    except Exception as problem:
        return f"{CASES}: cannot be read ({type(problem).__name__})"
    return "" if same else f"{CASES}: does not say what the rows of the cases say"
