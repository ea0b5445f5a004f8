"""Smooth functions through tabulated values; knows numbers, no muscles.

`interpolate` puts hierarchical B-splines on a `SparseGrid` of any dimension; `basis` gives their functions of one
variable, `Domain` the physical units, `compress` few modes for many components. docs/interpolation.md tells which to
take.
"""

from myograph.interpolation.basis import BASES, Basis, basis
from myograph.interpolation.domain import Domain
from myograph.interpolation.grid import SparseGrid
from myograph.interpolation.interpolant import Hierarchizer, Interpolant, interpolate
from myograph.interpolation.modes import Modes, compress

__all__ = [
    "BASES",
    "Basis",
    "Domain",
    "Hierarchizer",
    "Interpolant",
    "Modes",
    "SparseGrid",
    "basis",
    "compress",
    "interpolate",
]
