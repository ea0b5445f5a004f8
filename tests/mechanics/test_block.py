"""The discrete problem against closed forms, on a block."""

import ngsolve as ngs
import numpy as np
import pytest
from ngsolve.meshes import MakeStructured3DMesh
from scipy.optimize import brentq

from myograph.anatomy.load import built_in_arm
from myograph.materials.jets import JETS, Jet
from myograph.materials.stress import PRESSURE, Deformation
from myograph.mechanics.algebra import Tangent
from myograph.mechanics.assembly import Assembly
from myograph.mechanics.elements import mixed_elements
from myograph.mechanics.law import MuscleLaw, Place

MUSCLE = built_in_arm().muscles["biceps"]


def _solve_block(muscle, area):
    """Free block of belly with symmetry planes, Q2–Q1, fibres along x: F at one of its points when fully active."""
    mesh = MakeStructured3DMesh(hexes=True, nx=2, ny=1, nz=1)
    planes = {"dirichletx": "back", "dirichlety": "left", "dirichletz": "bottom"}
    space = ngs.VectorH1(mesh, order=2, **planes) * ngs.H1(mesh, order=1)
    elements = mixed_elements(mesh, ngs.IntegrationRule(ngs.HEX, 5))
    fibre = np.repeat(np.eye(3)[:, :1], elements.weights.size, axis=1)
    vector = np.zeros(space.ndof)
    for share in np.linspace(0.25, 1, 4):
        law = MuscleLaw(muscle, float(share), 1.0, JETS)
        body = Assembly(elements, fibre, lambda at, p, points, law=law: law.energy(at, p, Place(1.0, area)))
        for _ in range(12):
            body.tangent(vector)
            vector = vector - Tangent(body.matrix, space.FreeDofs()).solve(body.residual(vector))
    return body.deformation_gradient(vector)[20]


@pytest.mark.parametrize("area", [400.0, 2000.0])
def test_an_active_block_rests_where_fibre_and_matrix_balance(area):
    """Incompressible, stretches l, 1/√l, 1/√l:  dW/dl = 2 c1 (l - 1/l²) + 2 c2 (1 - 1/l³) + T(l)/A = 0."""
    fibre = {"peak_stress": 0.03, "passive_stress": 0.0, "optimal_stretch": 1.37, "width_ascending": 0.22}
    belly = MUSCLE.belly.model_copy(update=fibre | {"bulk": 1e6, "c1": 0.02, "c2": 0.005})
    tissue = MUSCLE.tissue.model_copy(update={"prestretch": 1.0, "pcsa": 1000.0, "full_area": 1e-3})
    muscle = MUSCLE.model_copy(update={"belly": belly, "tissue": tissue})
    F = _solve_block(muscle, area)
    stretches, shear = np.diag(F), F - np.diag(np.diag(F))
    slim = 1 + 0.5 * (-1 + np.hypot(1, 0.1))

    def balance(stretch):
        x = stretch / belly.optimal_stretch - 1
        active = belly.peak_stress * np.exp(-((x / belly.width_ascending) ** 2)) * tissue.pcsa / area
        isotropic = 2 * belly.c1 * (stretch - stretch**-2) + 2 * belly.c2 * (1 - stretch**-3)
        return slim * isotropic + active

    expected = brentq(balance, 0.3, 1.0)
    assert expected < 0.99
    assert stretches[0] == pytest.approx(expected, rel=2e-4)
    assert stretches[1:] == pytest.approx([expected**-0.5] * 2, rel=2e-4)
    assert np.abs(shear).max() < 1e-8


def test_the_reference_body_is_free_of_stress_without_prestretch_and_activation():
    """In a tendon at rest: no force at all where F = I."""
    at_rest = Deformation(np.eye(3)[:, :, None], np.array([[0.0], [0.6], [0.8]]))
    law, pressure = MuscleLaw(MUSCLE, 0.0, 0.0, JETS), Jet.variable(PRESSURE, np.zeros(1))
    stress = at_rest.stress(law.energy(at_rest.invariants(), pressure, Place(np.zeros(1), np.full(1, 40.0))))[:, :, 0]
    pressure = np.trace(stress) / 3
    assert stress - pressure * np.eye(3) == pytest.approx(np.zeros((3, 3)), abs=1e-12)
    assert pressure == pytest.approx(0, abs=1e-12)
