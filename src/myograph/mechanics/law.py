r"""Energy per reference volume of muscle and tendon, summed from parts: matrix, fibre, volume.

    W = c1 (I1bar - 3) + c2 (I2bar - 3) + (γ Φ_belly(l) + (1 - γ) Φ_tendon(l)) / A + p (J - 1) - p² / (2 κ)

with I1bar, I2bar of F G0, where G0 stretches the matrix along the fibre as the fibre is pre-stretched in the
reference body; l = |F a0|; γ the muscle's fraction; A the area of the reference section. Fibres run in bundles of
constant force: Φ' is the force of the whole bundle, so that the first Piola–Kirchhoff stress is T(l) / (A l) F a0 ⊗
a0 and tapered ends carry what the belly carries.

Convention: T / A is force per reference area; the other habit in print, S = T / A a0 ⊗ a0, pulls l times harder.
Trap: every switch is smooth, else Newton chatters for ever; and the term in p² must stay, else the matrix loses its
quasi-definiteness and the factorisation without pivoting fails.
"""

from dataclasses import dataclass
from math import pi, sqrt

import ngsolve as ngs

from myograph.anatomy.model import Fibre, Matrix, Tendons

Scalar = ngs.CoefficientFunction


@dataclass(frozen=True)
class Site:
    """What the law needs to know of a place: fibre direction, muscle fraction, section area [mm²]."""

    fibre: ngs.CoefficientFunction
    fraction: Scalar
    area: Scalar


def positive(value: Scalar, width: float) -> Scalar:
    """Smooth positive part (v + sqrt(v² + width²)) / 2: never zero, slope 1/2 at zero."""
    return 0.5 * (value + ngs.sqrt(value * value + width**2))


def belly_energy(stretch: Scalar, prestretch: Scalar, fibre: Fibre, activation: Scalar) -> Scalar:
    """Energy [N] whose derivative over the fibre's stretch is the bundle's force [N].

    The antiderivative of pos(e)^n is q^(n+1)/(n+1) + toe²/4 q^(n-1)/(n-1) with q = pos(e), a logarithm where n = 1;
    that of the Gauss bell is the error function.
    """
    total = stretch * prestretch
    q = positive(total - 1, fibre.toe)
    n = fibre.passive_exponent
    tail = ngs.log(q) if n == 1 else q ** (n - 1) / (n - 1)
    passive = fibre.passive_force * (q ** (n + 1) / (n + 1) + 0.25 * fibre.toe**2 * tail)
    x = total / fibre.optimal_stretch - 1
    bell = ngs.IfPos(x, _bell(x, fibre.width_descending), _bell(x, fibre.width_ascending))
    return (passive + activation * fibre.active_force * fibre.optimal_stretch * bell) / prestretch


def _bell(x: Scalar, width: float) -> Scalar:
    return 0.5 * sqrt(pi) * width * ngs.erf(x / width)


def tendon_energy(stretch: Scalar, tendons: Tendons) -> Scalar:
    """Energy [N] of a tendon whose force is quadratic in the strain up to the toe's end, linear beyond, zero below."""
    strain, toe = stretch - 1, tendons.toe
    quadratic = strain**3 / (6 * toe)
    linear = 0.5 * strain * strain - 0.5 * toe * strain + toe**2 / 6
    return tendons.stiffness * ngs.IfPos(strain - toe, linear, ngs.IfPos(strain, quadratic, 0.0 * strain))


def matrix_energy(elastic: Scalar, volume_ratio: Scalar, matrix: Matrix, site: Site) -> Scalar:
    """Isochoric Mooney–Rivlin energy [MPa] of the elastic deformation F G0."""
    C = elastic.trans * elastic
    first = ngs.Trace(C)
    second = 0.5 * (first * first - ngs.Trace(C * C))
    slim = positive(matrix.full_area / site.area - 1, 0.1) + 1
    c1 = site.fraction * slim * matrix.c1 + (1 - site.fraction) * matrix.tendon_c1
    c2 = site.fraction * slim * matrix.c2
    return c1 * (volume_ratio ** (-2 / 3) * first - 3) + c2 * (volume_ratio ** (-4 / 3) * second - 3)


def volume_energy(volume_ratio: Scalar, pressure: Scalar, bulk: float) -> Scalar:
    """Perturbed Lagrangian of the volume constraint [MPa]; its stationary pressure is κ (J - 1)."""
    return pressure * (volume_ratio - 1) - pressure * pressure / (2 * bulk)


@dataclass(frozen=True)
class MuscleLaw:
    """The law of one muscle; `activation` and `ramp` (of the pre-stretch, 0 to 1) may be numbers or NGSolve
    parameters."""

    fibre: Fibre
    tendons: Tendons
    matrix: Matrix
    activation: Scalar
    ramp: Scalar

    def energy(self, F: Scalar, pressure: Scalar, site: Site) -> Scalar:
        """Energy per reference volume [MPa] of the deformation gradient and the pressure."""
        J = ngs.Det(F)
        a0 = site.fibre
        prestretch = 1 + self.ramp * site.fraction * (self.fibre.prestretch - 1)
        across = prestretch ** (-0.5)
        G0 = across * ngs.Id(3) + (prestretch - across) * ngs.OuterProduct(a0, a0)
        Fa = F * a0
        stretch = ngs.sqrt(ngs.InnerProduct(Fa, Fa))
        belly = belly_energy(stretch, prestretch, self.fibre, self.activation)
        bundle = site.fraction * belly + (1 - site.fraction) * tendon_energy(stretch, self.tendons)
        return (
            matrix_energy(F * G0, J, self.matrix, site)
            + bundle / site.area
            + volume_energy(J, pressure, self.matrix.bulk)
        )
