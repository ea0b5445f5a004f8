"""A muscle of two hexahedra in three cases."""

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.fields import von_mises
from myograph.mesh.hexahedra import lattice
from myograph.mesh.vtk import skin_of


def box():
    """Two 27-node hexahedra, 20 x 10 x 10 mm together."""
    x = np.arange(5)
    points = 5.0 * np.array([(i, j, k) for k in range(3) for j in range(3) for i in x])
    steps = (lattice((0.0, 1.0, 2.0)) @ [1, 5, 15]).astype(int)
    cells = np.stack([steps, steps + 2])
    return Body(points, skin_of(points, cells), cells)


@pytest.fixture(scope="session")
def cases():
    body = box()
    draw = np.random.default_rng(3)
    activation = draw.uniform(size=(3, 5))
    stress = draw.normal(size=(3, 45, 6))
    fields = {
        "position": body.reference * (1 + activation[:, 2, None, None]),
        "cauchy_stress": stress,
        "von_mises": von_mises(stress),
        "pressure": draw.normal(size=(3, 45)),
    }
    return cases_in_memory("biceps", body, activation, ["factorial", "off_grid", "off_grid"], fields, np.arange(3.0))
