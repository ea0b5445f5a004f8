"""A saved graph element network built anew, for its weights to be loaded."""

from collections.abc import Mapping
from typing import Any

from myograph.config import parse
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.muscle import MuscleGen
from myograph.learning.gen.scaling import blank_scaling


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> MuscleGen:
    """The module of this configuration, with weights of no meaning; the configuration says all shapes."""
    told = parse(dict(config), NetworkConfig, "graph element network")
    return MuscleGen(told, blank_scaling(told.input_features + told.output_features), seed=0)
