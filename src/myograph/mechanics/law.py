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

import ngsolve as ngs

from myograph.anatomy.model import Muscle
from myograph.materials.functions import Scalar
from myograph.materials.functions import positive as positive_part
from myograph.materials.invariants import Invariants
from myograph.mechanics.functions import NGSOLVE, field_invariants

_SLIM_SOFTNESS = 0.1


@dataclass(frozen=True)
class Site:
    """What the law needs to know of a place: fibre direction, belly's fraction, section area [mm²]."""

    fibre: ngs.CoefficientFunction
    fraction: Scalar
    area: Scalar


def positive(value: Scalar, width: float) -> Scalar:
    """Smooth positive part (v + sqrt(v² + width²)) / 2: never zero, slope 1/2 at zero."""
    return positive_part(value, width, NGSOLVE)


@dataclass(frozen=True)
class MuscleLaw:
    """The law of one muscle; `activation` and `ramp` (of the pre-stretch, 0 to 1) may be numbers or NGSolve
    parameters."""

    muscle: Muscle
    activation: Scalar
    ramp: Scalar

    def energy(self, F: Scalar, pressure: Scalar, site: Site) -> Scalar:
        """Energy per reference volume [MPa] of the deformation gradient and the pressure."""
        at, belly = field_invariants(F, site.fibre), self.muscle.belly
        prestretch = 1 + self.ramp * site.fraction * (self.muscle.tissue.prestretch - 1)
        volume = pressure * belly.volume_strain(at.J, NGSOLVE) - pressure * pressure / (2 * belly.bulk_modulus)
        share = site.fraction
        return share * self._belly(at, prestretch, site) + (1 - share) * self._tendon(at, site) + volume

    def _belly(self, at: Invariants, prestretch: Scalar, site: Site) -> Scalar:
        tissue, law = self.muscle.tissue, self.muscle.belly
        elastic = at.prestretched(prestretch)
        matrix = law.matrix(elastic if tissue.prestretch_matrix else at, NGSOLVE)
        fibre = self.ramp * (law.passive_fibre(elastic, NGSOLVE) + self.activation * law.active(elastic, NGSOLVE))
        if not tissue.bundles:
            return matrix + fibre
        slim = 1 + positive(tissue.full_area / site.area - 1, _SLIM_SOFTNESS)
        return slim * matrix + tissue.pcsa / (site.area * prestretch) * fibre

    def _tendon(self, at: Invariants, site: Site) -> Scalar:
        tissue, law = self.muscle.tissue, self.muscle.tendon
        share = tissue.tendon_area / site.area if tissue.bundles else 1.0
        return law.matrix(at, NGSOLVE) + share * law.passive_fibre(at, NGSOLVE)
