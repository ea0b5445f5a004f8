"""The discrete problem against closed forms, on a block."""

import ngsolve as ngs
import numpy as np
import pytest
from ngsolve.meshes import MakeStructured3DMesh
from scipy.optimize import brentq

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.law import MuscleLaw, Site

MUSCLE = built_in_arm().muscles["biceps"]


def _solve_block(law, site):
    """Free block with symmetry planes, Q2–Q1: mean stretch along x, y, z."""
    mesh = MakeStructured3DMesh(hexes=True, nx=2, ny=1, nz=1)
    planes = {"dirichletx": "back", "dirichlety": "left", "dirichletz": "bottom"}
    space = ngs.VectorH1(mesh, order=2, **planes) * ngs.H1(mesh, order=1)
    (u, p), _ = space.TnT()
    form = ngs.BilinearForm(space)
    form += ngs.Variation(law.energy(ngs.Id(3) + ngs.Grad(u), p, site).Compile() * ngs.dx)
    state = ngs.GridFunction(space)
    change, residual = state.vec.CreateVector(), state.vec.CreateVector()
    for share in np.linspace(0.25, 1, 4):
        law.activation.Set(share * law.full)
        for _ in range(12):
            form.Apply(state.vec, residual)
            form.AssembleLinearization(state.vec)
            change.data = form.mat.Inverse(space.FreeDofs(), "sparsecholesky") * residual
            state.vec.data -= change
    F = ngs.Id(3) + ngs.Grad(state.components[0])
    values = np.array(F(mesh(0.9, 0.6, 0.3))).reshape(3, 3)
    return np.diag(values), values - np.diag(np.diag(values))


class _RampedLaw(MuscleLaw):
    full = 1.0


@pytest.mark.parametrize("area", [400.0, 2000.0])
def test_an_active_block_rests_where_fibre_and_matrix_balance(area):
    """Incompressible, stretches l, 1/√l, 1/√l:  dW/dl = 2 c1 (l - 1/l²) + 2 c2 (1 - 1/l³) + T(l)/A = 0."""
    fibre = {"peak_stress": 0.03, "passive_stress": 0.0, "optimal_stretch": 1.37, "width_ascending": 0.22}
    belly = MUSCLE.belly.model_copy(update=fibre | {"bulk": 1e6, "c1": 0.02, "c2": 0.005})
    tissue = MUSCLE.tissue.model_copy(update={"prestretch": 1.0, "pcsa": 1000.0, "full_area": 1e-3})
    muscle = MUSCLE.model_copy(update={"belly": belly, "tissue": tissue})
    law = _RampedLaw(muscle, ngs.Parameter(0.0), ngs.CoefficientFunction(1.0))
    one = ngs.CoefficientFunction(1.0)
    site = Site(ngs.CoefficientFunction((1.0, 0.0, 0.0)), one, area * one)
    stretches, shear = _solve_block(law, site)
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
    law = MuscleLaw(MUSCLE, ngs.CoefficientFunction(0.0), ngs.CoefficientFunction(0.0))
    mesh = MakeStructured3DMesh(hexes=True, nx=1, ny=1, nz=1)
    F = ngs.Id(3).MakeVariable()
    zero = ngs.CoefficientFunction(0.0)
    site = Site(ngs.CoefficientFunction((0.0, 0.6, 0.8)), zero, ngs.CoefficientFunction(40.0))
    stress = np.array(law.energy(F, zero, site).Diff(F)(mesh(0.5, 0.5, 0.5))).reshape(3, 3)
    pressure = np.trace(stress) / 3
    assert stress - pressure * np.eye(3) == pytest.approx(np.zeros((3, 3)), abs=1e-12)
    assert pressure == pytest.approx(0, abs=1e-12)
