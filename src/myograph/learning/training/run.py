"""All that changes as a training goes on, and one step of it."""

import math
import time
from typing import Any

import numpy as np
import torch
from lightning_fabric import Fabric
from torch import Tensor, nn

from myograph.errors import InputError, NotConvergedError
from myograph.learning.training.averaging import Average
from myograph.learning.training.best import Best
from myograph.learning.training.config import TrainingConfig
from myograph.learning.training.history import Course, StepRecord, Stop
from myograph.learning.training.processes import set_up
from myograph.learning.training.schedule import rate_at
from myograph.learning.training.trainable import NamesCompiled, Trainable

BETAS = (0.9, 0.95)
"""Memory of Adam; that of the gradients' size is short, as the training is."""


class _Judged(nn.Module):
    """The loss as a forward pass: what Fabric puts precision and the averaging of gradients around."""

    def __init__(self, trainable: Trainable) -> None:
        super().__init__()
        self.module = trainable.module
        self._loss = trainable.loss

    def forward(self, generator: np.random.Generator) -> tuple[Tensor, float]:
        return self._loss(generator)


class Run:
    """A training between two steps.

    Chance depends on the seed and on the number of the step alone, so that nothing of it is to be stored.
    """

    def __init__(self, trainable: Trainable, config: TrainingConfig, fabric: Fabric) -> None:
        self.trainable, self.config, self.fabric = trainable, config, fabric
        self.module = trainable.module.train()
        self._compiled = trainable.compiled() if isinstance(trainable, NamesCompiled) else self.module
        if config.compile:
            self._compiled.compile()
        groups = trainable.parameter_groups(config.learning_rate)
        fused = config.precision != "16-mixed"
        self.optimiser = torch.optim.AdamW(groups, betas=BETAS, weight_decay=config.weight_decay, fused=fused)
        self._largest = [group["lr"] for group in self.optimiser.param_groups]
        self._judged, self._stepper = set_up(fabric, _Judged(trainable), self.optimiser)
        self.average = Average(self.module, config.averaging) if config.averaging else None
        self.course, self.best = Course(), Best()
        self._started = time.perf_counter()

    @property
    def step(self) -> int:
        """Number of steps done."""
        return len(self.course.records)

    def continue_clock(self) -> None:
        """Count the time from the last of the steps done."""
        done = self.course.records[-1].elapsed if self.course.records else 0.0
        self._started = time.perf_counter() - done

    def stopped(self) -> Stop | None:
        """Why no further step is due, or None."""
        if self.step >= self.config.steps:
            return "steps"
        if self.config.patience is not None and self.best.waited >= self.config.patience:
            return "patience"
        return "seconds" if self.step and self._time_is_over(self.course.records[-1].elapsed) else None

    def take_step(self) -> StepRecord:
        """One step of the optimiser and all that belongs to it.

        Raises NotConvergedError where the loss is not finite.
        """
        number = self.step + 1
        share = self._share_done(number)
        rate = rate_at(self.config.schedule, share)
        for group, largest in zip(self.optimiser.param_groups, self._largest, strict=True):
            group["lr"] = rate * largest
        loss, rmse = self._descend(number)
        self.trainable.after_step(number)
        if self.average is not None:
            self.average.update(number)
        elapsed = self._elapsed()
        record = StepRecord(loss, rmse, rate, self._validate(number, elapsed), elapsed)
        self.course.records.append(record)
        return record

    def settle(self) -> None:
        """Give the module the weights to keep (the best, or the averaged, or the last) and take it off its device.

        What was compiled is plain again: elsewhere, and asked in other numbers, it would be compiled anew.
        """
        if self.best.weights:
            self.module.load_state_dict(self.best.weights)
        elif self.average is not None:
            self.average.settle()
        self._compiled._compiled_call_impl = None
        self.module.cpu().eval()

    def scaler_state(self) -> dict[str, Any]:
        """Of mixed precision; empty for others."""
        return self.fabric.strategy.precision.state_dict()

    def _descend(self, number: int) -> tuple[float, float]:
        _seed_torch(_torch_seed(self.config.seed, number, self.fabric.global_rank), self.fabric.device)
        loss, rmse = self._judged(np.random.default_rng((self.config.seed, number)))
        mean_loss, mean_square = self._over_processes(loss.item(), rmse**2)
        if not math.isfinite(mean_loss):
            raise NotConvergedError(f"training: the loss is {mean_loss} at step {number}; try a smaller learning_rate")
        self._stepper.zero_grad()
        self.fabric.backward(loss)
        if self.config.clip is not None:
            self.fabric.clip_gradients(self._judged, self._stepper, max_norm=self.config.clip, error_if_nonfinite=False)
        self._stepper.step()
        return mean_loss, math.sqrt(mean_square)

    def _over_processes(self, loss: float, square: float) -> tuple[float, float]:
        if self.fabric.world_size == 1:
            return loss, square
        both = torch.tensor([loss, square], dtype=torch.float64, device=self.fabric.device)
        mean = self.fabric.all_reduce(both, reduce_op="mean")
        assert isinstance(mean, Tensor)
        return float(mean[0]), float(mean[1])

    def _validate(self, number: int, elapsed: float) -> float:
        """Mean error on held-out pairs [mm], where it is due; NaN otherwise."""
        last = number >= self.config.steps or self._time_is_over(elapsed)
        if number % self.config.validate_every and not last:
            return math.nan
        error = self._held_out_error()
        if error is None and self.config.patience is not None:
            raise InputError("patience: expected cases to validate on, got none; set 'validation', such as 0.1")
        return math.nan if error is None else error

    def _held_out_error(self) -> float | None:
        if self.average is None:
            return self._judge_weights()
        with self.average.in_place():
            return self._judge_weights()

    def _judge_weights(self) -> float | None:
        """Error of the weights that the module has now; keeps them if they are the best."""
        self.module.eval()
        with torch.no_grad():
            error = self.fabric.broadcast(self.trainable.validation_mm())
        self.module.train()
        if error is not None:
            self.best.take(error, self.module, self.config.smallest_gain)
        return error

    def _time_is_over(self, elapsed: float) -> bool:
        return self.config.seconds is not None and elapsed >= self.config.seconds

    def _share_done(self, number: int) -> float:
        """Share of the steps, or of the time where that is further on."""
        share = number / self.config.steps
        if self.config.seconds is None:
            return share
        return max(share, self._elapsed() / self.config.seconds)

    def _elapsed(self) -> float:
        """Time since the start [s]; where it decides something, all processes have that of the first."""
        elapsed = time.perf_counter() - self._started
        return elapsed if self.config.seconds is None else self.fabric.broadcast(elapsed)


def _seed_torch(seed: int, device: torch.device) -> None:
    """Seed the generators in use; `torch.manual_seed` would remember its caller for GPUs that are not there."""
    torch.default_generator.manual_seed(seed)
    if device.type == "cuda":
        torch.cuda.manual_seed(seed)


def _torch_seed(seed: int, step: int, rank: int) -> int:
    return int(np.random.SeedSequence((seed, step, rank)).generate_state(1, np.uint64)[0] >> 1)
