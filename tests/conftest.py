"""Shapes and types in signatures are checked while the tests run, and only then.

NGSolve and the networks' torch are loaded here, in the order that lets them live in one process (see
`myograph.learning`), whatever a test file imports first. The numbers with derivatives are left unchecked: they have no
shapes in their signatures, and to check a call costs more than the call.

There are as many workers as processors: each computes on one thread, as does what it starts.
"""

import importlib
import os

os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")

from jaxtyping import install_import_hook

import tests.typechecked

importlib.import_module("myograph.materials.jets")
install_import_hook("myograph", f"{tests.typechecked.__name__}.checked")
for module in ("ngsolve", "myograph.learning"):
    importlib.import_module(module)
