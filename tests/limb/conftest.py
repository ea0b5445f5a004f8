"""An arm whose tables are made from formulas, not from finite elements."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.limb.table import MuscleTable, Record, regular_grid, table_key
from myograph.limb.table_arm import TableArm

STRENGTH = {"brachioradialis": 5e3, "brachialis": 8e3, "biceps": 2e4, "anconeus": -1e3, "triceps": -2e4}


def formula_table(arm, name):
    """Moment = strength (0.2 + activation) (2 - angle); positions shrink with activation."""
    grid = regular_grid(arm, 6, 4)
    angle, activation = np.meshgrid(grid.angles, grid.activations, indexing="ij")
    reference = np.random.default_rng(1).normal(size=(12, 3)) * 50
    shrink = (1 - 0.1 * activation * angle)[..., None, None]
    stress = np.broadcast_to(activation[..., None, None] * np.arange(1.0, 7), (*angle.shape, 12, 6))
    fields = {
        "position": reference * shrink,
        "cauchy_stress": stress.copy(),
        "fibre_stretch": np.broadcast_to(shrink[..., 0], (*angle.shape, 12)).copy(),
        "pressure": np.zeros((*angle.shape, 12)),
    }
    moments = STRENGTH[name] * (0.2 + activation) * (2 - angle if STRENGTH[name] > 0 else 1)
    key = table_key(arm, name, "tiny", grid)
    quads = np.array([[0, 1, 2, 3]])
    none = np.zeros(angle.shape)
    record = Record(np.ones(angle.shape, dtype=np.int64), none, none + 1, none, np.full(angle.shape, ""))
    return MuscleTable(name, key, grid, moments, fields, reference, quads, record)


@pytest.fixture
def formula_arm():
    arm = built_in_arm()
    return TableArm(arm, {name: formula_table(arm, name) for name in MUSCLES})
