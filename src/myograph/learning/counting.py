"""Multiplications of one answer, counted while it is made.

Torch counts two operations for every multiply-add of its matrix products; everything else (element-wise, softmax) is
left out, as is usual.
"""

from torch.utils.flop_counter import FlopCounterMode

from myograph.ensemble.pairs.question import Question
from myograph.learning.torch_predictor import TorchPredictor


def multiply_adds(predictor: TorchPredictor, question: Question) -> int:
    """Multiply-adds of matrix products for one pair of the question, at all its queries."""
    with FlopCounterMode(display=False) as counter:
        predictor.outputs(question)
    return round(counter.get_total_flops() / 2 / question.size)
