"""Training of anything that draws batches and judges them: `train(trainable, config, progress, folder)`.

trainable    what is trained: the contract
config       how
loop         the loop
drawing      batches, and pairs held out, as most trainables want them
checkpoint   what is on disk; resuming
about        what must be the same for that
logs         what is written beside it
"""

from myograph.learning.training.config import TrainingConfig
from myograph.learning.training.history import History
from myograph.learning.training.loop import train
from myograph.learning.training.trainable import Trainable

__all__ = ["History", "Trainable", "TrainingConfig", "train"]
