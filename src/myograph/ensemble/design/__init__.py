"""Which cases to compute: designs of experiments in activation, load and angle, seeded and fixed once made.

A design is described by a `DesignSpec` (one table of a TOML file), and made by `make_design`. docs/ensembles.md says
which methods there are.
"""

from myograph.ensemble.design.cases import Design
from myograph.ensemble.design.making import make_design
from myograph.ensemble.design.plain import factorial_cases, off_grid_cases
from myograph.ensemble.design.spec import DesignSpec

__all__ = ["Design", "DesignSpec", "factorial_cases", "make_design", "off_grid_cases"]
