r"""Energy per reference volume of a muscle, composed of two laws: that of its belly and that of its tendon.

    W = γ (s_m W_matrix(F G0 or F) + s_b (W_passive + a W_active)(F G0))        belly
      + (1 - γ) (V_matrix(F) + s_t V_passive(F))                                tendon
      + p θ(J) - p² / (2 K)                                                     volume, θ and K of the belly's law

with γ the smooth fraction of belly, a the activation, and G0 = l0^(-1/2) 1 + (l0 - l0^(-1/2)) a0 ⊗ a0, which stretches
the belly as it is pre-stretched in the reference body: l0 = 1 + ramp γ (prestretch - 1). The ramp, 0 to 1 on the way to
the muscle at rest, also multiplies the belly's fibres: at 0 nothing pulls.

Bundles: fibres carry the same force everywhere along the muscle, so that tapered ends carry what the belly carries.
With A the area of the reference section s_b = pcsa / (A l0), s_t = tendon_area / A: the first Piola–Kirchhoff stress
along the fibre is that of the law times pcsa / A. The matrix is stiffer where the section is small, s_m = 1 +
pos(full_area / A - 1). Without bundles all three are 1.

Trap: every switch must be smooth, else Newton chatters for ever; and the term in p² must stay, else the matrix loses
its quasi-definiteness and the factorisation without pivoting fails.
"""

from dataclasses import dataclass

from myograph.anatomy.model import Muscle
from myograph.materials.functions import Functions, Scalar, positive
from myograph.materials.invariants import Invariants

_SLIM_SOFTNESS = 0.1


@dataclass(frozen=True)
class Place:
    """What the law needs to know of a place: fraction of belly (0 to 1), area of the section there [mm²]."""

    fraction: Scalar
    area: Scalar


@dataclass(frozen=True)
class MuscleLaw:
    """The law of one muscle at an activation and a ramp of the pre-stretch (both 0 to 1).

    `functions` are those of what it is evaluated with: numbers, jets, or anything else with + - * / **.
    """

    muscle: Muscle
    activation: Scalar
    ramp: Scalar
    functions: Functions

    def energy(self, at: Invariants, pressure: Scalar, place: Place) -> Scalar:
        """Energy per reference volume [MPa] of the invariants of F and the fibre, and of the pressure [MPa]."""
        belly, share = self.muscle.belly, place.fraction
        prestretch = 1 + self.ramp * share * (self.muscle.tissue.prestretch - 1)
        volume = pressure * belly.volume_strain(at.J, self.functions) - pressure * pressure / (2 * belly.bulk_modulus)
        return share * self._belly(at, prestretch, place) + (1 - share) * self._tendon(at, place) + volume

    def _belly(self, at: Invariants, prestretch: Scalar, place: Place) -> Scalar:
        tissue, law, f = self.muscle.tissue, self.muscle.belly, self.functions
        elastic = at.prestretched(prestretch)
        matrix = law.matrix(elastic if tissue.prestretch_matrix else at, f)
        fibre = self.ramp * (law.passive_fibre(elastic, f) + self.activation * law.active(elastic, f))
        if not tissue.bundles:
            return matrix + fibre
        slim = 1 + positive(tissue.full_area / place.area - 1, _SLIM_SOFTNESS, f)
        return slim * matrix + tissue.pcsa / (place.area * prestretch) * fibre

    def _tendon(self, at: Invariants, place: Place) -> Scalar:
        tissue, law, f = self.muscle.tissue, self.muscle.tendon, self.functions
        share = tissue.tendon_area / place.area if tissue.bundles else 1.0
        return law.matrix(at, f) + share * law.passive_fibre(at, f)
