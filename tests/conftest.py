"""Shapes and types in signatures are checked while the tests run, and only then."""

from jaxtyping import install_import_hook

import tests.typechecked

install_import_hook("myograph", f"{tests.typechecked.__name__}.checked")
