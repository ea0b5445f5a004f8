"""Muscle activations in, deformed muscles out.

A finite-element arm computes the truth, graph networks learn it, and anything downstream uses either through one
door: a `Case` is asked, a `Simulator` answers with a `Solution`.
"""

from importlib.metadata import version

from myograph.case import MUSCLES, Case, Simulator, Solution
from myograph.errors import InputError, MyographError, NotConvergedError

__version__ = version("myograph")

__all__ = [
    "MUSCLES",
    "Case",
    "InputError",
    "MyographError",
    "NotConvergedError",
    "Simulator",
    "Solution",
    "__version__",
]
