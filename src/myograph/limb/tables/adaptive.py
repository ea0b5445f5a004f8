"""A table that grows where it is worst: points of the largest surpluses get children until the error is small.

The surplus of a point is what the interpolant of all coarser points misses there. It counts by the volume of its
function, for the tolerances are means over the box.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int

from myograph.anatomy.model import Arm
from myograph.interpolation import Domain, SparseGrid
from myograph.limb.tables.held_out import HeldOut, measured
from myograph.limb.tables.provenance import provenance, table_key
from myograph.limb.tables.spec import BASIS, TableSpec, box
from myograph.limb.tables.state import State
from myograph.limb.tables.table import MuscleTable, compressed, recorded

_SHARE = 0.1
"""Share of the points that are refined in one round."""


@runtime_checkable
class States(Protocol):
    """Answers points of the box with states of one muscle, in the points' order."""

    arm: Arm
    name: str
    preset: str

    @property
    def reference(self) -> Float[np.ndarray, "nodes 3"]:
        """Nodes in the reference body [mm]."""
        ...

    @property
    def skin(self) -> Int[np.ndarray, "quads 4"]:
        """Quadrilaterals of the surface."""
        ...

    def __call__(self, points: Float[np.ndarray, "points 2"], /) -> list[State]:
        """States at points of (angle [rad], activation); failed ones with their reason."""
        ...


def built(states: States, spec: TableSpec) -> MuscleTable:
    """The table of a muscle: the regular grid, refined until it meets its tolerances or has as many states as it may.

    Where a state fails the table stays as it is, with the reason in its record.
    """
    grid, domain, key = spec.start(), box(states.arm), table_key(states.arm, states.name, states.preset, spec)
    solved = states(domain.from_unit(grid.coordinates(BASIS)))
    held_out = states(spec.held_out_points(domain)) if spec.held_out else []
    while True:
        table = _table(states, (spec, domain, key), grid, solved, held_out)
        finer = None if table.met or table.failures else _refined(table)
        if finer is None:
            return table
        solved += states(domain.from_unit(finer.coordinates(BASIS)[len(grid) :]))
        grid = finer


def _table(
    states: States,
    asked: tuple[TableSpec, Domain, str],
    grid: SparseGrid,
    solved: Sequence[State],
    held_out: Sequence[State],
) -> MuscleTable:
    """The table on a grid, with its errors."""
    spec, domain, key = asked
    spent = sum(state.seconds for state in (*solved, *held_out))
    table = MuscleTable(
        muscle=states.name,
        preset=states.preset,
        spec=spec,
        key=key,
        domain=domain,
        grid=grid,
        moments=np.array([state.moment for state in solved]),
        modes=compressed(solved, len(states.reference)),
        reference=states.reference,
        skin=states.skin,
        record=recorded(solved),
        held_out=HeldOut.none(),
        provenance=provenance(states.arm, spent),
    )
    return replace(table, held_out=measured(held_out, None if table.failures else table))


def _refined(table: MuscleTable) -> SparseGrid | None:
    """The grid with more points, or None where that would be more than allowed."""
    surpluses = table.surpluses()
    for count in range(max(1, int(_SHARE * table.size)), 0, -1):
        finer = table.grid.surplus_refined(surpluses, count=count, by_volume=True)
        if table.size < len(finer) <= table.spec.most_states:
            return finer
    return None
