"""Muscle activations in, deformed muscles out.

A finite-element arm computes the truth, graph networks learn it, and anything downstream uses either through one
door: a `Case` is asked, a `Simulator` answers with a `Solution`.
"""

from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from myograph.case import MUSCLES, Case, Simulator, Solution
from myograph.errors import InputError, MyographError, NotConvergedError

if TYPE_CHECKING:
    from myograph.inference.loaded import LoadedModel

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
    "load",
]


def load(folder: Path | str, threads: int = 1) -> "LoadedModel":
    """A saved model, ready to answer; see `myograph.inference.loaded.load`."""
    from myograph.inference.loaded import load as load_model

    return load_model(folder, threads)
