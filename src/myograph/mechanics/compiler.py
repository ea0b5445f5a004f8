"""Energies as machine code, where a C++ compiler is at hand.

NGSolve's wrapper of the compiler is a script in the folder of the running Python's programs; it is found only where
that folder is on the PATH, which is not so when Python is called by its full path.
"""

import os
import shutil
import sysconfig

import ngsolve as ngs


def compiled(function: ngs.CoefficientFunction, native: bool) -> ngs.CoefficientFunction:
    """The function flattened for fast evaluation; as machine code if asked for and a compiler is there."""
    if not (native and shutil.which("c++")):
        return function.Compile()
    before = os.environ.get("PATH", "")
    os.environ["PATH"] = os.pathsep.join([sysconfig.get_path("scripts"), before])
    try:
        return function.Compile(realcompile=True, wait=True)
    finally:
        os.environ["PATH"] = before
