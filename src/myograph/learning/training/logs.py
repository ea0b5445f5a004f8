"""The course of a training on disk: always a CSV file, TensorBoard's files where they are asked for.

    course.csv     step, loss, rmse_mm, rate, validation_mm (empty where not measured), seconds
    tensorboard/   the same as scalars; histograms of the parameters; the graph's mesh as it moves

A training that goes on writes the steps of its checkpoint first: rows of steps that were lost do not stay.
"""

import csv
import math
from contextlib import ExitStack, nullcontext, suppress
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import torch

from myograph.errors import InputError, MissingPackageError
from myograph.files import refusing
from myograph.learning.training.history import StepRecord
from myograph.learning.training.run import Run
from myograph.learning.training.trainable import HasMesh

if TYPE_CHECKING:
    from torch.utils.tensorboard import SummaryWriter

FILE, BOARD = "course.csv", "tensorboard"
HEAD = ("step", "loss", "rmse_mm", "rate", "validation_mm", "seconds")


class CourseLog:
    """Writes the steps of a run to a folder; without a folder it writes nothing."""

    def __init__(self, folder: Path | None, run: Run) -> None:
        self._folder, self._run = folder, run
        self._file: Any = None
        self._board: SummaryWriter | None = None

    def __enter__(self) -> "CourseLog":
        if self._folder is not None:
            try:
                self._open(self._folder)
            except InputError:
                with suppress(InputError):
                    self._close(self._folder)
                raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._folder is not None:
            with suppress(InputError) if problem is not None else nullcontext():
                self._close(self._folder)

    def add(self, record: StepRecord) -> None:
        """Write the step that was just done; raises InputError where there is no room for it."""
        if self._folder is None:
            return
        step, config = self._run.step, self._run.config
        if step % config.log_every == 0:
            with refusing(self._folder / FILE):
                self._write(step, record)
        if self._board is not None:
            with refusing(self._folder / BOARD):
                self._show(self._board, step, record)

    def _open(self, folder: Path) -> None:
        with refusing(folder / FILE):
            folder.mkdir(parents=True, exist_ok=True)
            self._file = (folder / FILE).open("w", encoding="utf-8", newline="", buffering=1)
            csv.writer(self._file).writerow(HEAD)
            for step, record in enumerate(self._run.course.records, start=1):
                if step % self._run.config.log_every == 0:
                    self._write(step, record)
        if self._run.config.tensorboard:
            with refusing(folder / BOARD):
                self._board = _board(folder / BOARD, self._run.step)

    def _close(self, folder: Path) -> None:
        """Close what is open; what waits to be written may find no room yet."""
        with ExitStack() as opened:
            for name, writer in ((FILE, self._file), (BOARD, self._board)):
                if writer is not None:
                    opened.enter_context(refusing(folder / name))
                    opened.callback(writer.close)

    def _write(self, step: int, record: StepRecord) -> None:
        validation = "" if math.isnan(record.validation) else record.validation
        row = (step, record.loss, record.rmse, record.rate, validation, record.elapsed)
        csv.writer(self._file).writerow(row)

    def _show(self, board: "SummaryWriter", step: int, record: StepRecord) -> None:
        config = self._run.config
        if step % config.log_every == 0:
            _add_scalars(board, step, record)
        if step % config.histogram_every == 0:
            _add_shapes(board, step, self._run)


def _board(folder: Path, steps_done: int) -> "SummaryWriter":
    """A writer whose steps take the place of equal ones of before; it is imported here as that takes seconds."""
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        raise MissingPackageError("tensorboard", "train", "TensorBoard's view of a training") from None
    return SummaryWriter(str(folder), purge_step=steps_done + 1)


def _add_scalars(board: "SummaryWriter", step: int, record: StepRecord) -> None:
    board.add_scalar("loss", record.loss, step)
    board.add_scalar("rmse_mm", record.rmse, step)
    board.add_scalar("rate", record.rate, step)
    if not math.isnan(record.validation):
        board.add_scalar("validation_mm", record.validation, step)


def _add_shapes(board: "SummaryWriter", step: int, run: Run) -> None:
    for name, parameter in run.module.named_parameters():
        board.add_histogram(name, parameter.detach().cpu(), step)
    if isinstance(run.trainable, HasMesh):
        nodes, triangles = run.trainable.mesh()
        vertices, faces = torch.tensor(nodes, dtype=torch.float32), torch.tensor(triangles, dtype=torch.int32)
        board.add_mesh("graph", vertices[None], faces=faces[None], global_step=step)
