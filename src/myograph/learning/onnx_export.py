"""A torch module as an ONNX network with a free number of pairs and queries, and of sensors where these are free.

Names of inputs and outputs are the signature's. What torch notes about the source code it came from is taken out.
"""

import contextlib
import copy
import logging
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor, nn

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.question import Question
from myograph.errors import InputError, MissingPackageError
from myograph.inference.feeds import WITHOUT_BATCH, feeds
from myograph.inference.signature import Signature
from myograph.learning.onnx_parity import check_parity, example_question
from myograph.learning.saveable import Saveable


@dataclass(frozen=True)
class Exported:
    """The network's bytes, its opset, and the largest relative difference from torch."""

    network: bytes
    opset: int
    parity: float


def export(model: Saveable, cases: MuscleCases, split: Split, opset: int = 18) -> Exported:
    """Export the module and compare; the questions are about training pairs.

    Raises InputError for a module that cannot be exported so, or not in that operator set, NotConvergedError where
    onnxruntime answers otherwise.
    """
    network = _network(model, example_question(model.signature, cases, split), opset)
    return Exported(network, opset, check_parity(model, network, cases, split))


class _Positional(nn.Module):
    """The module behind a list of arguments, whatever names its own `forward` gives them."""

    def __init__(self, module: nn.Module) -> None:
        super().__init__()
        self.module = copy.deepcopy(module).cpu().eval()

    def forward(self, *arguments: Tensor) -> Any:
        return self.module(*arguments)


def _network(model: Saveable, example: Question, opset: int) -> bytes:
    signature = model.signature
    given = tuple(torch.from_numpy(array) for array in feeds(example, signature.inputs).values())
    try:
        with _silence():
            program = torch.onnx.export(
                _Positional(model.module),
                given,
                input_names=list(signature.inputs),
                output_names=list(signature.outputs),
                dynamic_shapes=(_free(signature),),
                opset_version=opset,
                dynamo=True,
                verbose=False,
            )
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "train", "saving a model") from None
    except Exception as problem:
        reason = next((line for line in str(problem).splitlines() if line.strip()), type(problem).__name__)
        raise InputError(
            f"{model.name}: expected a module that torch.onnx.export takes with a free number of pairs and queries, "
            f"got: {reason}"
        ) from problem
    assert program is not None
    _check_opset(model.name, program.model_proto, opset)
    return _without_sources(program.model_proto)


def _check_opset(name: str, network: Any, opset: int) -> None:
    """Raise InputError where torch wrote another operator set than was asked for, as it does with a mere warning."""
    found = next((item.version for item in network.opset_import if item.domain in ("", "ai.onnx")), None)
    if found != opset:
        raise InputError(
            f"{name}: opset: expected one that torch can write this network in, got {opset}: it would be {found}; take "
            "that, or convert it by `myograph export onnx --opset`"
        )


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """Keep back what torch says of packages that are not needed here."""
    logger = logging.getLogger("torch.onnx")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.setLevel(level)


def _free(signature: Signature) -> tuple[dict[int, Any], ...]:
    """For every input: axis -> name of the number that is free there."""
    batch, sensors, queries = (torch.export.Dim(name) for name in ("batch", "sensors", "queries"))
    found = []
    for name in signature.inputs:
        axes = {} if name in WITHOUT_BATCH else {0: batch}
        points = len(axes)
        if name.startswith("query_"):
            axes[points] = queries
        if name.startswith("sensor_") and signature.any_sensors:
            axes[points] = sensors
        found.append(axes)
    return tuple(found)


def _without_sources(model: Any) -> bytes:
    """The network without stack traces and names of files, and with short names inside: a tenth of a small one."""
    del model.metadata_props[:]
    _shorten(model.graph)
    for part in (model.graph, *model.graph.node, *model.graph.value_info, *model.functions):
        del part.metadata_props[:]
        part.doc_string = ""
    for function in model.functions:
        for node in function.node:
            del node.metadata_props[:]
            node.doc_string = ""
    return model.SerializeToString()


def _shorten(graph: Any) -> None:
    """Number what only the network itself names; inputs, outputs and constants keep their names."""
    if any(attribute.HasField("g") for node in graph.node for attribute in node.attribute):
        return
    kept = {item.name for part in (graph.input, graph.output, graph.initializer) for item in part} | {""}
    short: dict[str, str] = {}
    for node in graph.node:
        node.name = ""
        for names in (node.input, node.output):
            for place, name in enumerate(names):
                if name not in kept:
                    names[place] = short.setdefault(name, f"v{len(short)}")
    del graph.value_info[:]
