r"""Active contraction as FEBio prescribes it: a stress that the activation scales, with no force–length curve.

    isotropic:  σ = T B / J        W = T (I1 - 3) / 2
    fibre:      σ = T n ⊗ n / J    W = T (I4 - 1) / 2,  n = F a0, not normalised

Convention: T is a second Piola–Kirchhoff stress, S = T 1 or S = T a0 ⊗ a0; as force per reference area it grows with
the stretch.
"""

from typing import Literal

from myograph.materials.functions import Scalar
from myograph.materials.invariants import Invariants

Contraction = Literal["none", "isotropic", "fibre"]


def contraction_energy(kind: Contraction, stress: float, at: Invariants) -> Scalar:
    """Energy [MPa] of full activation with T = `stress` [MPa]."""
    if kind == "isotropic":
        return 0.5 * stress * (at.I1 - 3)
    if kind == "fibre":
        return 0.5 * stress * (at.I4 - 1)
    return 0.0 * at.J
