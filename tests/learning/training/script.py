"""A training as a process of its own: python -m tests.learning.training.script FOLDER SETTINGS_AS_JSON.

Prints the number of each step, and at the end the losses as JSON.
"""

import json
import sys
from pathlib import Path

import torch

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.learning.training import TrainingConfig, train
from tests.learning.conftest import stand_in
from tests.learning.training.field import Field


def run(folder, settings):
    torch.set_num_threads(1)
    config = TrainingConfig(**settings)
    cases = stand_in()
    field = Field(cases, split_pairs(cases, "strict"), config, settings_dropout(config))
    return train(field, config, lambda step, *_: say(step), folder)


def say(what):
    sys.stdout.write(f"{what}\n")
    sys.stdout.flush()


def settings_dropout(config):
    """Dropout makes what several processes compute differ from what one does: only where the batch is small."""
    return 0.2 if config.batch < 8 else 0.0


if __name__ == "__main__":
    history = run(Path(sys.argv[1]), json.loads(sys.argv[2]))
    say(json.dumps({"loss": history.loss.tolist(), "rmse": history.rmse.tolist()}))
