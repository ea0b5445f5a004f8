"""How a training goes, whatever is trained."""

from typing import Literal

from pydantic import Field

from myograph.config import Model

Schedule = Literal["one_cycle", "cosine", "constant"]
Device = Literal["auto", "cpu", "cuda"]
Precision = Literal["32-true", "bf16-mixed", "16-mixed"]


class TrainingConfig(Model):
    """Settings of a training.

    Parameters
    ----------
    steps
        Number of optimiser steps, at most.
    seconds
        Time limit [s]; the schedule then follows whichever is further on, time or steps. With a limit the losses depend
        on the machine's speed.
    batch
        Pairs in a step, over all processes.
    queries
        Query nodes in a step, drawn at random; all of them where there are fewer.
    learning_rate
        Largest rate of the weights.
    node_learning_rate
        Largest rate of the positions of a graph's nodes, which live in the unit box.
    schedule
        Course of the rates: 'one_cycle' rises in a line and falls in a cosine, 'cosine' falls, 'constant' stays.
    weight_decay
        Share of a weight that goes at a step, times the rate (AdamW).
    clip
        Largest norm of all gradients together; None leaves them.
    averaging
        Decay of the exponential moving average of the weights, such as 0.999, which then is what is validated and kept;
        0 keeps the last weights.
    validation
        Share of the training cases that are held out to validate on; 0 for none.
    validate_every
        Steps between validations.
    patience
        Validations without gain before training stops and the best weights are taken; None never stops, and takes the
        best weights too where there is validation.
    smallest_gain
        What counts as gain, as a share of the best error so far.
    seed
        Of all chance: of weights, batches, dropout, held-out cases.
    device
        'auto' takes a CUDA GPU where there is one.
    precision
        Arithmetic: '32-true', or mixed with bfloat16, or with float16 (GPU only).
    compile
        Whether `torch.compile` makes the module faster: slow to start, for long training; needs a C++ compiler.
    checkpoint_every
        Steps between checkpoints, in a training that has a folder.
    log_every
        Steps between rows of the log, and between scalars of TensorBoard.
    tensorboard
        Whether TensorBoard's files are written beside the log.
    histogram_every
        Steps between TensorBoard's histograms of the parameters, and between its pictures of the mesh.
    triangulate_every
        Steps between triangulations of a graph whose nodes move; another one follows the last step.
    """

    steps: int = Field(default=2000, ge=1)
    seconds: float | None = Field(default=None, gt=0)
    batch: int = Field(default=8, ge=1)
    queries: int = Field(default=64, ge=1)
    learning_rate: float = Field(default=6e-3, gt=0)
    node_learning_rate: float = Field(default=3e-3, ge=0)
    schedule: Schedule = "one_cycle"
    weight_decay: float = Field(default=0.0, ge=0)
    clip: float | None = Field(default=None, gt=0)
    averaging: float = Field(default=0.0, ge=0, lt=1)
    validation: float = Field(default=0.0, ge=0, le=0.5)
    validate_every: int = Field(default=100, ge=1)
    patience: int | None = Field(default=None, ge=1)
    smallest_gain: float = Field(default=1e-3, ge=0)
    seed: int = Field(default=0, ge=0, lt=2**63)
    device: Device = "auto"
    precision: Precision = "32-true"
    compile: bool = False
    checkpoint_every: int = Field(default=500, ge=1)
    log_every: int = Field(default=1, ge=1)
    tensorboard: bool = False
    histogram_every: int = Field(default=200, ge=1)
    triangulate_every: int = Field(default=50, ge=1)
