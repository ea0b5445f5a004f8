r"""The ground substance of Blemker and others: shear along the fibres and across them, each with its modulus.

    W = G1 B1² + G2 B2²,   B1² = I5 / I4² - 1,   B2 = acosh(x),   x = (I1 I4 - I5) / (2 sqrt(I4)),   isochoric

Neither sees a stretch along the fibre: that is the fibre's own part of a law.

Trap: acosh has an infinite slope at x = 1, which is the reference; its square is smooth there, and is taken from its
series near x = 1 and from the logarithm beyond, whose argument is held away from 1 where it is not used.
Source: Blemker, Pinsky, Delp 2005 (Journal of Biomechanics 38), after Criscione and others 2001.
"""

from math import comb

from myograph.materials.functions import Functions, Scalar
from myograph.materials.invariants import Invariants

_SWITCH = 0.1
_SERIES = tuple(2 * (-1) ** (n - 1) * 2.0**n / (n * n * comb(2 * n, n)) for n in range(1, 12))


def shear_energy(G1: float, G2: float, at: Invariants, f: Functions) -> Scalar:
    """G1 B1² + G2 B2² [MPa]."""
    bar = at.isochoric()
    along = bar.I5 / (bar.I4 * bar.I4) - 1
    return G1 * along + G2 * acosh_squared((bar.I1 * bar.I4 - bar.I5) / (2 * f.sqrt(bar.I4)), f)


def acosh_squared(x: Scalar, f: Functions) -> Scalar:
    """acosh(x)², smooth at x = 1 and continued below it."""
    y = x - 1
    near = _SERIES[-1]
    for coefficient in _SERIES[-2::-1]:
        near = near * y + coefficient
    far = f.where(y - 0.5 * _SWITCH, x, 1 + 0.5 * _SWITCH)
    root = f.log(far + f.sqrt(far * far - 1))
    return f.where(y - _SWITCH, root * root, near * y)
