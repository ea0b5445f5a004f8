"""The group `cases` of a store: all numbers of all cases in one place, for readers that know Zarr only.

It repeats what the rows say and is written anew at the end of every run.
"""

import os
import shutil
import uuid
from pathlib import Path

from myograph.ensemble.store.aside import ASIDE
from myograph.ensemble.store.opening import cases_dataset
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.rows import read_row

CASES = "cases"


def write_summary(store: Path, plan: StorePlan) -> None:
    """Write the group; raises OSError without room."""
    dataset = cases_dataset(plan, [read_row(store, case) for case in range(plan.size)])
    aside = store / ASIDE / uuid.uuid4().hex
    dataset.to_zarr(aside, mode="w", consolidated=False, zarr_format=3)
    shutil.rmtree(store / CASES, ignore_errors=True)
    os.replace(aside, store / CASES)
