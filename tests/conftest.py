"""Shapes and types in signatures are checked while the tests run, and only then."""

from jaxtyping import install_import_hook

install_import_hook("myograph", "beartype.beartype")
