"""A torch module that answers questions: the common shape of all learned methods."""

from dataclasses import dataclass
from itertools import chain

import numpy as np
import torch
from torch import Tensor, nn

from myograph.config import Model
from myograph.ensemble.pairs.question import Answer, Question
from myograph.errors import InputError
from myograph.inference.answers import answer_of, check_outputs
from myograph.inference.feeds import WITHOUT_BATCH, check_inputs, feeds
from myograph.inference.question import check_question
from myograph.inference.signature import Signature


def trained_numbers(module: nn.Module) -> int:
    """How many numbers of a module a training changes; modes and means that are merely kept are none."""
    return sum(parameter.numel() for parameter in module.parameters() if parameter.requires_grad)


@dataclass(frozen=True)
class TorchPredictor:
    """A `myograph.ensemble.pairs.predictor.Predictor` and a `myograph.learning.saveable.Saveable`.

    Raises InputError for a signature with a name that nobody knows.

    Parameters
    ----------
    name
        As it stands in tables.
    method
        A name of `myograph.learning.methods.REBUILD`.
    module
        Takes the signature's inputs, gives its outputs; all scaling is inside.
    signature
        What goes in and out.
    config
        All that is needed to build the module anew, weights aside.
    pairs_at_once
        Pairs that go through the module together.
    """

    name: str
    method: str
    module: nn.Module
    signature: Signature
    config: Model
    pairs_at_once: int = 16

    def __post_init__(self) -> None:
        check_inputs(self.signature.inputs)
        check_outputs(self.signature.outputs)

    @property
    def fields(self) -> tuple[str, ...]:
        """What it answers."""
        return self.signature.fields

    @property
    def parameters(self) -> int:
        """Number of trained numbers."""
        return trained_numbers(self.module)

    @property
    def stored(self) -> int:
        """Number of all numbers that it keeps, trained or not."""
        return sum(values.numel() for values in self.module.state_dict().values())

    def predict(self, question: Question) -> Answer:
        """Answer, in evaluation mode and without gradients.

        Raises InputError for a question that is not finite, not in the model's convention, or not from its sensors.
        """
        check_question(question, self.signature)
        return answer_of(self.outputs(question))

    def outputs(self, question: Question) -> dict[str, np.ndarray]:
        """What the module gives, by the signature's names, float32."""
        if question.size == 0:
            raise InputError("expected at least one pair, got none")
        given = feeds(question, self.signature.inputs)
        training = self.module.training
        self.module.eval()
        try:
            with torch.no_grad():
                parts = [self._part(given, first) for first in range(0, question.size, self.pairs_at_once)]
        finally:
            self.module.train(training)
        return {name: np.concatenate(arrays) for name, *arrays in zip(self.signature.outputs, *parts, strict=True)}

    def _part(self, given: dict[str, np.ndarray], first: int) -> tuple[np.ndarray, ...]:
        rows, device = slice(first, first + self.pairs_at_once), self._device()
        arguments = [array if name in WITHOUT_BATCH else array[rows] for name, array in given.items()]
        results = self.module(*(torch.from_numpy(array).to(device) for array in arguments))
        results = (results,) if isinstance(results, Tensor) else results
        return tuple(result.cpu().numpy() for result in results)

    def _device(self) -> torch.device:
        return next(chain(self.module.parameters(), self.module.buffers())).device
