"""One law of every name, in states that reach all its branches."""

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.materials.functions import NUMPY
from myograph.materials.invariants import Invariants, invariants
from myograph.materials.law import Law
from myograph.materials.literature import LITERATURE
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.materials.neo_hooke import NeoHooke
from myograph.materials.trans_iso_mooney_rivlin import TransIsoMooneyRivlin

BICEPS = built_in_arm().muscles["biceps"]
TRANS_ISO = TransIsoMooneyRivlin(C1=1.0, C2=0.5, C3=0.2, C4=10.0, C5=20.0, l_m=1.1, K=1000.0, active_stress=0.5)
NEO_HOOKE = NeoHooke(E=1.0, nu=0.3, contraction="isotropic", active_stress=0.5)
MOONEY_RIVLIN = MooneyRivlin(c1=1.0, c2=0.5, K=1000.0, contraction="fibre", active_stress=0.5)

EXAMPLES: dict[str, Law] = {
    **LITERATURE,
    "blemker own stretch": LITERATURE["blemker muscle"].model_copy(update={"isochoric_fibre": False}),
    "gauss": BICEPS.belly,
    "toe_tendon": BICEPS.tendon,
    "trans_iso_mooney_rivlin": TRANS_ISO,
    "neo_hooke isotropic": NEO_HOOKE,
    "neo_hooke fibre": NEO_HOOKE.model_copy(update={"contraction": "fibre"}),
    "mooney_rivlin": MOONEY_RIVLIN,
}

FIBRE = np.array([0.6, 0.0, 0.8])
SHORTENED = np.array([[0.75, 0.05, -0.02], [0.03, 1.12, 0.07], [-0.04, 0.02, 0.82]])
STRETCHED = np.array([[1.06, 0.05, -0.02], [0.03, 0.93, 0.07], [-0.04, 0.02, 1.04]])
FAR = np.array([[1.3, 0.05, -0.02], [0.03, 0.83, 0.07], [-0.04, 0.02, 1.4]])
STATES = {"shortened": SHORTENED, "stretched": STRETCHED, "far": FAR}


def energy(law: Law, F: np.ndarray, activation: float = 0.7, fibre: np.ndarray = FIBRE) -> float:
    """Energy with the pressure at its equilibrium [MPa]."""
    return float(law.energy(invariants(F, fibre), activation, NUMPY))


def piola(law: Law, F: np.ndarray, activation: float = 0.7, fibre: np.ndarray = FIBRE) -> np.ndarray:
    """First Piola–Kirchhoff stress by central differences of the energy [MPa]."""
    step, P = 1e-6, np.zeros((3, 3))
    for i, j in np.ndindex(3, 3):
        change = np.zeros((3, 3))
        change[i, j] = step
        P[i, j] = energy(law, F + change, activation, fibre) - energy(law, F - change, activation, fibre)
    return P / (2 * step)


def along_fibre(stretch: np.ndarray) -> Invariants:
    """Stretches l, 1/√l, 1/√l with the fibre along the first."""
    across = stretch**-0.5
    F = np.zeros((*np.shape(stretch), 3, 3))
    F[..., 0, 0], F[..., 1, 1], F[..., 2, 2] = stretch, across, across
    return invariants(F, np.broadcast_to([1.0, 0.0, 0.0], F.shape[:-1]).copy())


def slope(part, stretch: np.ndarray, step: float = 1e-5) -> np.ndarray:
    """dψ/dl of a part of a law along the fibre, by fourth-order differences [MPa]."""
    near, far = (part(along_fibre(stretch + s * step), NUMPY) for s in (1, 2))
    near_below, far_below = (part(along_fibre(stretch - s * step), NUMPY) for s in (1, 2))
    return (8 * (near - near_below) - (far - far_below)) / (12 * step)
