"""Homogeneous states against numbers and closed forms in print: laws without finite elements."""

import numpy as np
import pytest
from scipy.optimize import brentq, root

from myograph.materials.blemker import Blemker
from myograph.materials.functions import NUMPY
from myograph.materials.gauss import Gauss
from myograph.materials.guccione import Guccione
from myograph.materials.invariants import invariants
from myograph.materials.mooney_rivlin import MooneyRivlin, mooney_rivlin_energy
from myograph.materials.neo_hooke import NeoHooke
from tests.materials.cases import slope

FIBRE = np.array([1.0, 0.0, 0.0])


def _forces(law, stretches, activation):
    """dW/dl of the three principal stretches by fourth-order differences [MPa]."""
    step, forces = 1e-4, np.zeros(3)
    for k in range(3):
        values = []
        for s in (-2, -1, 1, 2):
            moved = stretches + s * step * np.eye(3)[k]
            values.append(float(law.energy(invariants(np.diag(moved), FIBRE), activation, NUMPY)))
        forces[k] = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
    return forces


def _free_cube(law, activation, along=None):
    """Stretches of a cube without load, its stretch along the fibre prescribed where given."""

    def full(unknown):
        return np.array([along, *unknown]) if along else unknown

    first = 1 if along else 0
    solved = root(lambda x: _forces(law, full(x), activation)[first:], np.full(3 - first, 0.98), tol=1e-13)
    return full(solved.x)


def _displacement_norm(stretches, prescribed=()):
    """Of the free components of a unit cube's eight nodes: each stretch moves four of them."""
    free = [k for k in range(3) if k not in prescribed]
    return np.sqrt(4 * np.sum((stretches[free] - 1) ** 2))


@pytest.mark.parametrize(
    ("law", "stretches", "gold"),
    [
        (NeoHooke(E=1, nu=0.3, contraction="isotropic", active_stress=0.5), [0.85756517] * 3, 0.493408719039),
        (
            NeoHooke(E=1, nu=0.3, contraction="fibre", active_stress=0.5),
            [0.72382915, 1.09774125, 1.09774125],
            0.61766348475,
        ),
        (
            MooneyRivlin(c1=1, K=1000, contraction="fibre", active_stress=0.5),
            [0.92827925, 1.03783782, 1.03783782],
            0.178966663838,
        ),
    ],
    ids=["ma20", "ma24", "ma25"],
)
def test_active_cubes_of_febio_contract_to_its_numbers(law, stretches, gold):
    found = _free_cube(law, 1.0)
    assert found == pytest.approx(stretches, abs=1e-8)
    assert _displacement_norm(found) == pytest.approx(gold, rel=1e-8)


def test_a_stretched_cube_of_blemkers_muscle_has_the_numbers_of_febio():
    """mu03: u_x = 0.2 along the fibre, at rest."""
    law = Blemker(G1=500, G2=500, P1=0.05, P2=6.6, L_ofl=1.0, l_star=1.4, sigma_max=3e5, K=1e7)
    found = _free_cube(law, 0.0, along=1.2)
    stress = _forces(law, found, 0.0)[0] / (found[1] * found[2])
    assert found[1:] == pytest.approx([0.91361773] * 2, abs=1e-8)
    assert _displacement_norm(found, prescribed=(0,)) == pytest.approx(0.244325959214, rel=1e-7)
    assert stress == pytest.approx(48984.42, rel=1e-6)


def _matrix_force(stretches, direction, c1=1.0, c2=0.5):
    """dW/dl of incompressible Mooney–Rivlin along a way of stretches [MPa]."""
    step = 1e-5
    low, high = (
        float(mooney_rivlin_energy(c1, c2, invariants(np.diag(stretches(direction + s)), FIBRE))) for s in (-step, step)
    )
    return (high - low) / (2 * step)


@pytest.mark.parametrize(
    ("way", "faces", "expected"),
    [
        (lambda x: np.array([x, x**-0.5, x**-0.5]), 1, 2.5498224852),
        (lambda x: np.array([x, x, x**-2]), 2, 4.9441284304),
        (lambda x: np.array([x, 1.0, 1 / x]), 1, 3.2948520710),
    ],
    ids=["uniaxial", "equibiaxial", "pure shear"],
)
def test_mooney_rivlin_has_its_closed_forms(way, faces, expected):
    """Cauchy stress l dW/dl per loaded direction at l = 1.3, c1 = 1, c2 = 0.5."""
    assert 1.3 * _matrix_force(way, 1.3) / faces == pytest.approx(expected, rel=1e-8)


def test_an_active_block_of_neo_hooke_with_a_second_piola_stress_shortens_to_its_cubic():
    """l³ = μ / (μ + T), incompressible."""
    mu, T = 1.0, 0.5
    law = MooneyRivlin(c1=mu / 2, K=1e6, contraction="fibre", active_stress=T)

    def force(stretch):
        return float(slope(law.matrix, np.array(stretch)) + slope(law.active, np.array(stretch)))

    assert brentq(force, 0.5, 1.0, xtol=1e-14) == pytest.approx((mu / (mu + T)) ** (1 / 3), rel=1e-9)


def test_an_isotropic_guccione_at_small_strain_has_its_shear_modulus():
    law = Guccione(C=0.02, bf=3.0, bt=3.0, bfs=3.0, bulk=10.0)
    shear, step = law.shear_modulus, 1e-4
    F = np.eye(3)
    F[0, 1] = step
    assert float(law.matrix(invariants(F, FIBRE), NUMPY)) == pytest.approx(0.5 * shear * step**2, rel=1e-6)


@pytest.mark.parametrize("shear_axis", [(0, 1), (1, 2)])
@pytest.mark.parametrize("name", ["gauss", "blemker"])
def test_the_shear_modulus_is_that_of_a_small_shear(name, shear_axis):
    blemker = Blemker(G1=0.5, G2=0.5, P1=0.05, P2=6.6, L_ofl=1.2, l_star=1.4, sigma_max=0.3, K=1e4)
    gauss = Gauss(
        c1=0.3, c2=0.2, bulk=1e4, passive_stress=0.0, passive_exponent=1, toe=0.1, peak_stress=0.0,
        optimal_stretch=1.0, width_ascending=0.3, width_descending=0.3,
    )  # fmt: skip
    law, step = {"gauss": gauss, "blemker": blemker}[name], 1e-3
    F = np.eye(3)
    F[shear_axis] = step
    assert float(law.matrix(invariants(F, FIBRE), NUMPY)) == pytest.approx(0.5 * law.shear_modulus * step**2, rel=1e-5)
