"""Laws as NGSolve sees them: the same numbers as NumPy, differentiated twice, in every way of evaluation."""

import shutil

import ngsolve as ngs
import numpy as np
import pytest
from ngsolve.meshes import MakeStructured3DMesh

from myograph.materials.functions import Functions
from myograph.mechanics.compiler import compiled
from myograph.mechanics.functions import NGSOLVE, field_invariants
from tests.materials.cases import EXAMPLES, FIBRE, STATES, energy, piola

MESH = MakeStructured3DMesh(hexes=True, nx=2, ny=1, nz=1)
POINT = MESH(0.3, 0.4, 0.5)
AXIS = ngs.CoefficientFunction(tuple(map(float, FIBRE)))

laws = pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())


def _matrix(F):
    return ngs.CoefficientFunction(tuple(map(float, F.ravel())), dims=(3, 3))


def _value(function):
    return np.array(function(POINT))


def test_ngsolve_offers_all_functions():
    assert isinstance(NGSOLVE, Functions)


@laws
@pytest.mark.parametrize("F", STATES.values(), ids=STATES.keys())
def test_both_evaluations_agree_and_stress_is_the_derivative_of_the_energy(law, F):
    """NGSolve's symbolic derivative against differences of NumPy's energy."""
    variable = _matrix(F).MakeVariable()
    field = law.energy(field_invariants(variable, AXIS), ngs.CoefficientFunction(0.7), NGSOLVE)
    stress = _value(field.Diff(variable)).reshape(3, 3)
    assert float(_value(field)) == pytest.approx(energy(law, F), rel=1e-11, abs=1e-14)
    assert stress == pytest.approx(piola(law, F), abs=1e-7 * np.abs(stress).max())


@laws
@pytest.mark.parametrize("F", [np.eye(3), *STATES.values()], ids=["reference", *STATES])
def test_the_second_derivative_is_finite_and_that_of_the_first(law, F):
    """At the reference only finite: some fibres set in there, and acosh would be infinitely steep."""
    variable = _matrix(F).MakeVariable()
    field = law.energy(field_invariants(variable, AXIS), ngs.CoefficientFunction(0.7), NGSOLVE)
    stress = field.Diff(variable)
    direction = np.random.default_rng(1).normal(size=(3, 3))
    tangent = _value(stress.Diff(variable, _matrix(direction))).reshape(3, 3)
    assert np.isfinite(tangent).all()
    if np.allclose(F, np.eye(3)):
        return

    def stress_at(G):
        moved = _matrix(G).MakeVariable()
        at = field_invariants(moved, AXIS)
        return _value(law.energy(at, ngs.CoefficientFunction(0.7), NGSOLVE).Diff(moved)).reshape(3, 3)

    step = 1e-6
    difference = (stress_at(F + step * direction) - stress_at(F - step * direction)) / (2 * step)
    assert tangent == pytest.approx(difference, abs=1e-6 * np.abs(tangent).max())


def _assembled(density, bend=True):
    """Energy, residual and tangent of a bent block, by the automatic differentiation of finite elements."""
    space = ngs.VectorH1(MESH, order=2) * ngs.H1(MESH, order=1)
    (u, p), _ = space.TnT()
    form = ngs.BilinearForm(space)
    form += ngs.Variation(density(ngs.Id(3) + ngs.Grad(u), p) * ngs.dx)
    state = ngs.GridFunction(space)
    if bend:
        x, y, z = ngs.x, ngs.y, ngs.z
        state.components[0].Set((0.2 * x + 0.03 * y, -0.1 * y + 0.05 * x * z, 0.1 * z))
        state.components[1].Set(0.1 * x)
    residual = state.vec.CreateVector()
    form.Apply(state.vec, residual)
    form.AssembleLinearization(state.vec)
    return form.Energy(state.vec), residual.FV().NumPy().copy(), np.array(form.mat.AsVector())


def _density(law):
    return lambda F, p: law.mixed_energy(field_invariants(F, AXIS), p, ngs.Parameter(0.7), NGSOLVE)


@laws
@pytest.mark.parametrize("bend", [False, True], ids=["reference", "bent"])
def test_flattened_energies_assemble_to_the_same_numbers_as_interpreted_ones(law, bend):
    plain = _assembled(_density(law), bend)
    flat = _assembled(lambda F, p: _density(law)(F, p).Compile(), bend)
    assert all(np.isfinite(part).all() for part in plain)
    assert np.linalg.norm(plain[2]) > 0
    for ours, theirs in zip(flat, plain, strict=True):
        assert ours == pytest.approx(theirs, rel=1e-10, abs=1e-11 * np.abs(theirs).max())


@pytest.mark.exhaustive
@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler here")
def test_all_laws_as_machine_code_assemble_to_the_same_numbers():
    """One sum with one law of every name, compiled once."""
    laws_by_name = {law.law: law for law in EXAMPLES.values()}

    def density(F, p):
        return sum((_density(law)(F, p) for law in laws_by_name.values()), ngs.CoefficientFunction(0.0))

    plain = _assembled(lambda F, p: density(F, p).Compile())
    native = _assembled(lambda F, p: compiled(density(F, p), native=True))
    for ours, theirs in zip(native, plain, strict=True):
        assert ours == pytest.approx(theirs, rel=1e-9, abs=1e-10 * np.abs(theirs).max())
