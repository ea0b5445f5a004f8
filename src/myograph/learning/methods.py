"""Which function builds a saved model's module anew, by the name of the method.

Each is `rebuild(config, shapes) -> module`: `config` is what `model.json` says under 'config', to be parsed by the
method's own pydantic model; `shapes` are those of the saved weights by name, for what the configuration does not say.
The module's parameters and persistent buffers are overwritten by the saved ones. What a file says is only ever looked
up here: a saved model cannot name code to be run.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from torch import nn

from myograph.errors import InputError

Shapes = Mapping[str, tuple[int, ...]]
Rebuild = Callable[[Mapping[str, Any], Shapes], nn.Module]

REBUILD: dict[str, str] = {
    "gen": "myograph.learning.gen.rebuild:rebuild",
    "modes": "myograph.learning.modes.rebuild:rebuild",
    "gappy_pod": "myograph.learning.baselines.gappy_module:rebuild",
    "feed_forward": "myograph.learning.baselines.node_network:rebuild",
    "deeponet": "myograph.learning.baselines.deeponet_module:rebuild",
    "pod_gp": "myograph.learning.baselines.gp_module:rebuild",
}
"""Method -> module:function."""


def rebuild_of(method: str) -> Rebuild:
    """The function; raises InputError for a method that is not known."""
    if method not in REBUILD:
        raise InputError(f"method '{method}': expected one of {', '.join(REBUILD)}; is the model of a newer version?")
    module, _, function = REBUILD[method].partition(":")
    return getattr(import_module(module), function)
