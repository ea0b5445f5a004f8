r"""FEBio's public test problems of one element: a unit cube on three planes of symmetry, free elsewhere.

    ma20  neo-Hooke, isotropic contraction           σ_active = T B / J
    ma24  neo-Hooke, contraction along the fibres    σ_active = T n ⊗ n / J,  n = F a0
    ma25  Mooney–Rivlin, contraction along the fibres (not made deviatoric)
    mu03  Blemker's muscle at rest, stretched by 0.2 along its fibres

The quantity is FEBio's own: the Euclidean norm of all free displacement components at the eight corners. FEBio uses
one trilinear element; every solution is homogeneous, so that any element has it, and to all digits.
Trap: stretched along its fibres a body has B1 = B2 = 0, so that mu03 says nothing of G1 and G2.
Source: FEBio test suite, gold numbers; for mu03 also the stress, from the homogeneous solution. The gold number of mu03
itself ends 8e-10 from that solution, where FEBio's iteration stopped; hence the tolerance.
"""

from myograph.materials.blemker import Blemker
from myograph.materials.law import Law
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.materials.neo_hooke import NeoHooke
from myograph.mechanics.specimen import Box, Load, Specimen, SpecimenState, solve
from myograph.verification.check import Check

ISOTROPIC = NeoHooke(E=1.0, nu=0.3, contraction="isotropic", active_stress=0.5)
FIBRE = NeoHooke(E=1.0, nu=0.3, contraction="fibre", active_stress=0.5)
RUBBER = MooneyRivlin(c1=1.0, K=1000.0, contraction="fibre", active_stress=0.5)
BLEMKER = Blemker(G1=500.0, G2=500.0, P1=0.05, P2=6.6, L_ofl=1.0, l_star=1.4, sigma_max=3e5, K=1e7)


def contracted(law: Law) -> float:
    """Norm of the free displacements [mm] of a free cube at full activation."""
    return solve(Specimen(Box(), law), Load(activation=1.0)).free_norm


def stretched(law: Law) -> SpecimenState:
    """A cube at rest that is stretched by a fifth along its fibres."""
    return solve(Specimen(Box(), law), Load(displacement={"x_max": (0.2, None, None)}))


_NORM, _SOURCE, _TOLERANCE = "norm of free displacements [mm]", "FEBio test suite", 1e-8
CHECKS = (
    Check("febio.ma20", _NORM, lambda: contracted(ISOTROPIC), 0.493408719039, _SOURCE, _TOLERANCE),
    Check("febio.ma24", _NORM, lambda: contracted(FIBRE), 0.61766348475, _SOURCE, _TOLERANCE),
    Check("febio.ma25", _NORM, lambda: contracted(RUBBER), 0.178966663838, _SOURCE, _TOLERANCE),
    Check("febio.mu03", _NORM, lambda: stretched(BLEMKER).free_norm, 0.244325959214, _SOURCE, _TOLERANCE),
    Check(
        "febio.mu03_stress",
        "Cauchy stress along the fibres [MPa]",
        lambda: float(stretched(BLEMKER).mean_stress[0, 0]),
        48984.42,
        "homogeneous solution of mu03",
        1e-6,
    ),
)
