"""What names a simulator and travels to a worker, and the bodies that its fields live on."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int


@dataclass(frozen=True)
class Body:
    """The reference body of a muscle.

    Parameters
    ----------
    reference
        Nodes [mm].
    skin
        Quadrilaterals of the surface, outward normal; a triangle repeats its last corner.
    cells
        Nodes of each element; none where the simulator has no elements.
    """

    reference: Float[np.ndarray, "nodes 3"]
    skin: Int[np.ndarray, "facets 4"]
    cells: Int[np.ndarray, "cells element_nodes"]


@dataclass(frozen=True)
class SimulatorSpec:
    """All that a worker needs to make the simulator.

    Parameters
    ----------
    kind
        'table', 'direct', or 'package.module:function'.
    preset
        Size of the meshes.
    arm
        The arm as JSON (`Arm.model_dump_json`).
    tables
        Folder of the tables, for 'table'; for 'direct' those from whose equilibria the search begins, if wanted.
    gravity
        Whether the forearm's own weight acts.
    """

    kind: str
    preset: str
    arm: str
    tables: str | None = None
    gravity: bool = True

    @property
    def remembers(self) -> bool:
        """Whether answers may depend on the cases before: for all but tables."""
        return self.kind != "table"
