"""Saved neural modes built anew, for their numbers to be loaded."""

from collections.abc import Mapping
from typing import Any

from myograph.config import parse
from myograph.learning.modes.config import BuiltModes
from myograph.learning.modes.module import ModesModule


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> ModesModule:
    """The module of this configuration, with numbers of no meaning; the configuration says all shapes."""
    return ModesModule(parse(dict(config), BuiltModes, "neural modes"))
