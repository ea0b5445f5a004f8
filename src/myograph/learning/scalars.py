"""TensorBoard scalars of a training, or none."""

from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from myograph.errors import MissingPackageError

if TYPE_CHECKING:
    from torch.utils.tensorboard import SummaryWriter


class ScalarLog:
    """Writes scalars to a folder; without a folder it writes nothing.

    TensorBoard is imported only where it is asked for: it takes seconds.
    """

    def __init__(self, folder: Path | None) -> None:
        self._writer = None if folder is None else _writer(folder)

    def __enter__(self) -> "ScalarLog":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._writer is not None:
            self._writer.close()

    def write(self, step: int, loss: float, rmse_mm: float) -> None:
        """Add one step: the loss [-] and the root mean square error [mm]."""
        if self._writer is not None:
            self._writer.add_scalar("loss", loss, step)
            self._writer.add_scalar("rmse_mm", rmse_mm, step)


def _writer(folder: Path) -> "SummaryWriter":
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        raise MissingPackageError("tensorboard", "train", "writing the course of a training") from None
    return SummaryWriter(str(folder))
