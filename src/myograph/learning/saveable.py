"""What a torch model must offer to be saved, deployed and loaded again.

The module takes the parts of a Question that its signature names, in that order, and gives the outputs in order, in mm
and MPa: all scaling is inside it, as buffers. Batch, queries and, where the signature says so, sensors are free in
number. `torch.onnx.export(dynamo=True)` must understand its `forward`.

`method` names the function that builds the module anew from its configuration; see `myograph.learning.methods`.
"""

from typing import Protocol, runtime_checkable

from torch import nn

from myograph.config import Model
from myograph.inference.signature import Signature


@runtime_checkable
class Saveable(Protocol):
    """A trained model around a torch module; `TorchPredictor` is one."""

    @property
    def name(self) -> str:
        """As it stands in tables."""
        ...

    @property
    def method(self) -> str:
        """A name of `myograph.learning.methods.REBUILD`."""
        ...

    @property
    def module(self) -> nn.Module:
        """Question parts in, field values out; float32."""
        ...

    @property
    def signature(self) -> Signature:
        """Names of both, and of the sensors."""
        ...

    @property
    def config(self) -> Model:
        """All that is needed to build the module anew, weights aside."""
        ...
