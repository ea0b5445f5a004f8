"""Single precision within a training of mixed precision: for places and targets, which eight bits would move.

bfloat16 tells numbers apart by a 256th: of 300 mm that is a millimetre, and of squared distances in the unit box as
much as neighbouring nodes differ by.
"""

from contextlib import AbstractContextManager, nullcontext

import torch
from torch import Tensor


def single(x: Tensor) -> AbstractContextManager[object]:
    """Within it autocast is off where x is; where it is off anyway nothing is entered, and an export has no trace."""
    kind = x.device.type
    return torch.autocast(kind, enabled=False) if torch.is_autocast_enabled(kind) else nullcontext()
