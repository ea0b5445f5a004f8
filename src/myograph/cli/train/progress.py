"""Progress of one training on standard error: steps, error, time left."""

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from myograph.ensemble.pairs.predictor import Progress as Told


@contextmanager
def shown(name: str) -> Iterator[Told]:
    """What a learner tells its steps to."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[error]}"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task(f"training {name}", total=None, error="")

        def told(step: int, steps: int, rmse: float) -> None:
            bar.update(task, completed=step, total=steps, error=f"{rmse:.3g} mm")

        yield told
