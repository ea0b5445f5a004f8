"""An arm's tables from formulas, size tiny, in a folder, and specs of simulators that read them."""

import dataclasses

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.ensemble.spec import SimulatorSpec
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.provenance import table_key
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import save_table, table_path
from myograph.mesh.presets import preset_mesh
from tests.limb.conftest import STRENGTH, FormulaStates


def states(arm, name):
    """States of a formula on the tiny mesh."""
    mesh = preset_mesh(arm, name, "tiny")

    def formula(reference, angle, activation):
        grown, ones = 1 + 0.1 * activation * np.sin(angle), np.ones(len(reference))
        stress = np.outer(ones, activation * np.arange(1.0, 7))
        fields = {"position": reference * grown, "cauchy_stress": stress, "fibre_stretch": ones, "pressure": 0 * ones}
        return STRENGTH[name] * (0.2 + activation) * (2 - angle if STRENGTH[name] > 0 else 1), fields

    made = FormulaStates(arm, name, formula)
    made.reference, made.skin = mesh.points, mesh.skin
    return made


def save_tables(folder, asked=None):
    """Tables of all muscles on a regular grid."""
    arm = built_in_arm()
    for name in MUSCLES:
        table = built(states(arm, name), asked or TableSpec.regular(2))
        key = table_key(arm, name, "tiny", table.spec)
        save_table(dataclasses.replace(table, preset="tiny", key=key), table_path(folder, name))
    return folder


def spec(folder, /, **changes):
    arm = built_in_arm().model_dump_json()
    return SimulatorSpec(**{"kind": "table", "preset": "tiny", "arm": arm, "tables": str(folder), **changes})
