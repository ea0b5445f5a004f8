"""Graph element networks, the baselines they must beat, training and saved models; the only room that imports torch.

The baselines (`samples`, `baselines`) run without torch.

Trap: NGSolve opens its OpenBLAS for the whole process; a torch that is loaded later takes some matrix products from
there, with other arguments, and crashes. Here torch is loaded so that its own come first.
"""

import contextlib
import importlib
import os
import sys


def _load_torch_with_its_own_blas() -> None:
    flags = sys.getdlopenflags()
    sys.setdlopenflags(flags | os.RTLD_DEEPBIND)
    try:
        with contextlib.suppress(ModuleNotFoundError):
            importlib.import_module("torch")
    finally:
        sys.setdlopenflags(flags)


if sys.platform == "linux" and "ngsolve" in sys.modules and "torch" not in sys.modules:
    _load_torch_with_its_own_blas()
