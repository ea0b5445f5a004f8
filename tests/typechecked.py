"""The checker of types while the tests run: an int is a float, as type checkers have it (PEP 484)."""

from typing import Any

from beartype import BeartypeConf, beartype

_CONF = BeartypeConf(is_pep484_tower=True)


def checked(function: Any) -> Any:
    """Check the arguments and the result of a function at every call."""
    return beartype(conf=_CONF)(function)
