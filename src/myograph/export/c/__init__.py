"""A muscle as one C header and one C source: C99, no allocation, weights as constant arrays.

reduced     fewer modes and nodes, chosen by what they cost in accuracy
layers      modes as rows of float or of int8
wanted      how many of both meet a tolerance within a size
text        the header and the source
"""

from myograph.export.c.text import Source, c_source
from myograph.export.c.wanted import Wanted, reduced_muscle

__all__ = ["Source", "Wanted", "c_source", "reduced_muscle"]
