"""What can be trained: a module, how it draws and judges a batch, and how far it is off on pairs that teach nothing.

A learner makes one, hands it to `myograph.learning.training.train`, and builds its predictor from `module`.

Traps. `train` moves `module` to its device: tensors that `loss` makes belong on `device_of(module)`. All that a step
depends on must be in `module.state_dict()`, for checkpoints hold that and nothing else of the trainable: buffers that
change as training goes on (edges of a graph) must be persistent, dense, and of one shape, or be made anew by the module
from what is there. All chance comes from the generator and from torch, both of which `train` seeds anew at every step.
"""

from typing import Any, Protocol, runtime_checkable

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor, nn


@runtime_checkable
class Trainable(Protocol):
    """Fulfilled by anything that `train` can train."""

    @property
    def module(self) -> nn.Module:
        """What is trained, and stored in checkpoints."""
        ...

    def parameter_groups(self, rate: float) -> list[dict[str, Any]]:
        """Parameter groups for Adam, each with its own largest 'lr'; `rate` is the configured one.

        A group may name its own 'weight_decay'.
        """
        ...

    def loss(self, generator: np.random.Generator) -> tuple[Float[Tensor, ""], float]:
        """Draw a batch; its loss [-], and its root mean square error [mm].

        `myograph.learning.training.drawing.draw_batch` draws this process's share where there are several.
        """
        ...

    def validation_mm(self) -> float | None:
        """Mean error [mm] on pairs held out from training; None where none are."""
        ...

    def after_step(self, step: int) -> None:
        """Do what is due after the step of this number from 1, such as triangulating anew."""
        ...


@runtime_checkable
class NamesCompiled(Protocol):
    """A trainable whose loss does not call its module, but a part of it.

    Trap: `nn.Module.compile` makes a module's call faster and no other of its methods.
    """

    def compiled(self) -> nn.Module:
        """What the loss calls: what `compile = true` is for."""
        ...


@runtime_checkable
class HasMesh(Protocol):
    """A trainable whose graph can be shown as it moves."""

    def mesh(self) -> tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "triangles 3"]]:
        """Nodes [mm] and triangles between them."""
        ...


def device_of(module: nn.Module) -> torch.device:
    """Where the module's parameters live."""
    return next(module.parameters()).device
