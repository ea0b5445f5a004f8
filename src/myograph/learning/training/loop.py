"""The loop: step, log, checkpoint, until steps, time or patience end.

Same seed, same losses, on one machine and one number of threads, however often it was killed and resumed.
"""

from contextlib import ExitStack
from pathlib import Path

import torch

from myograph.ensemble.pairs.predictor import Progress
from myograph.learning.training.checkpoint import held, write_checkpoint
from myograph.learning.training.config import TrainingConfig
from myograph.learning.training.history import History
from myograph.learning.training.logs import CourseLog
from myograph.learning.training.processes import start_fabric
from myograph.learning.training.run import Run
from myograph.learning.training.trainable import Trainable


def train(
    trainable: Trainable,
    config: TrainingConfig,
    progress: Progress | None = None,
    folder: Path | None = None,
    about: str = "",
) -> History:
    """Train the trainable's module, in place; it ends on the CPU, in evaluation mode, with the weights to keep.

    Parameters
    ----------
    progress
        Told after every step, in the first process only.
    folder
        Where checkpoints and logs go; a training that was interrupted there goes on. Nothing is written without it.
    about
        What else must be the same for going on, such as the checksum of the data.

    Raises InputError for a folder of another training and for a device that is not there, NotConvergedError where the
    loss is not finite.
    """
    fabric = start_fabric(config)
    with ExitStack() as stack:
        stack.enter_context(torch.random.fork_rng(devices=[fabric.device] if fabric.device.type == "cuda" else []))
        run = Run(trainable, config, fabric)
        if folder is not None:
            stack.enter_context(held(folder, run, about))
        writes = folder if fabric.is_global_zero else None
        log = stack.enter_context(CourseLog(writes, run))
        stopped = run.stopped()
        while stopped is None:
            record = run.take_step()
            stopped = run.stopped()
            log.add(record)
            if writes is not None and (stopped or run.step % config.checkpoint_every == 0):
                write_checkpoint(writes, run, about)
            if progress is not None and fabric.is_global_zero:
                progress(run.step, config.steps, record.rmse)
        run.settle()
    return run.course.history(stopped)
