"""Where Newton's method may start at any point of the box: the unknowns of a table's states, interpolated like fields.

The states are those that `myograph table build` keeps beside the tables. What is solved from there is as true as
from anywhere else; it takes one or two tangents.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from myograph.anatomy.model import Arm
from myograph.interpolation import Hierarchizer, Interpolant
from myograph.limb.tables.solve import states_folder
from myograph.limb.tables.spec import BASIS
from myograph.limb.tables.state import StateStore, state_key
from myograph.limb.tables.table import MuscleTable


def interpolated_unknowns(
    folder: Path, arm: Arm, tables: Mapping[str, MuscleTable], preset: str
) -> dict[str, Interpolant]:
    """Muscle -> its unknowns over (angle [rad], activation), for tables of this preset whose states are all kept."""
    found = {}
    for name, table in tables.items():
        vectors = _vectors(folder, arm, table) if table.preset == preset else None
        if vectors is not None:
            found[name] = Hierarchizer(table.grid, BASIS, table.domain).interpolant(vectors)
    return found


def _vectors(folder: Path, arm: Arm, table: MuscleTable) -> np.ndarray | None:
    """Unknowns of all states of a table (points, unknowns), or None where one is not kept."""
    store = StateStore(states_folder(folder, table.muscle), state_key(arm, table.muscle, table.preset))
    vectors = []
    for angle, activation in table.points.tolist():
        state = store.get(angle, activation, len(table.reference))
        if state is None or (vectors and len(state.vector) != len(vectors[0])):
            return None
        vectors.append(state.vector)
    return np.stack(vectors)
