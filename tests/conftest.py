"""Shapes and types in signatures are checked while the tests run, and only then.

NGSolve and the networks' torch are loaded here, in the order that lets them live in one process (see
`myograph.learning`), whatever a test file imports first.
"""

import importlib

from jaxtyping import install_import_hook

import tests.typechecked

install_import_hook("myograph", f"{tests.typechecked.__name__}.checked")
for module in ("ngsolve", "myograph.learning"):
    importlib.import_module(module)
