"""A run as people see it: progress with rate and time left, the dashboard's address, and the result."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, Task, TextColumn, TimeElapsedColumn
from rich.progress import TimeRemainingColumn as TimeLeft
from rich.text import Text

from myograph.cli.dataset.pictures import draw_card_figure
from myograph.cli.options import print_json
from myograph.ensemble.card.text import FIGURE
from myograph.ensemble.store.plan import read_plan
from myograph.errors import InputError, MissingPackageError

if TYPE_CHECKING:
    from myograph.ensemble.running.listener import Listener
    from myograph.ensemble.running.run import RunOptions

Workers = Annotated[int | None, typer.Option(help="Local processes; without it one for each processor.")]
Tables = Annotated[
    Path | None, typer.Option(help="Folder of the tables, where they do not lie any more where they were.")
]
Scheduler = Annotated[str | None, typer.Option(help="Address of a Dask scheduler that runs already.")]
Slurm = Annotated[Path | None, typer.Option(help="TOML file: run as jobs of SLURM.")]
Again = Annotated[bool, typer.Option("--retry-failed", help="Try the cases again that failed in an earlier run.")]
TimeLimit = Annotated[float | None, typer.Option(help="Seconds after which a case has failed.")]


@dataclass(frozen=True)
class Where:
    """Where and how long cases are computed; see `RunOptions`."""

    workers: int | None
    scheduler: str | None = None
    slurm: Path | None = None
    time_limit: float | None = None
    again: bool = False
    tables: Path | None = None


def run_options(where: Where) -> "RunOptions":
    """The options of a run; raises InputError for what makes none, MissingPackageError without Dask."""
    try:
        from myograph.ensemble.running.cluster import read_slurm
        from myograph.ensemble.running.run import RunOptions
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "running an ensemble") from None
    options = RunOptions(
        where.workers,
        where.scheduler,
        where.slurm,
        where.time_limit,
        again=where.again,
        tables=where.tables,
    )
    if options.slurm is not None:
        read_slurm(options.slurm)
    return options


def compute(store: Path, options: "RunOptions") -> dict[str, Any]:
    """Compute what is missing, show progress, and draw the card's figure; what `run_store` returns."""
    from myograph.ensemble.running.run import run_store

    with _shown(read_plan(store).size) as listener:
        result = run_store(store, options, listener)
    if not (store / FIGURE).exists():
        _draw(store)
    return result


def _draw(store: Path) -> None:
    """Draw the card's figure; what cannot be drawn is no reason to call the run a failure."""
    try:
        draw_card_figure(store)
    except InputError as problem:
        typer.echo(f"myograph: no figure for the card: {problem}", err=True)


def tell(result: dict[str, Any], json: bool) -> None:
    """Print the result."""
    if json:
        print_json(result)
        return
    failed = f", {result['failed']} failed (see 'myograph ensemble status')" if result["failed"] else ""
    done = f"{result['done']} of {result['cases']} cases done{failed}"
    typer.echo(f"{done} in {result['seconds']:.1f} s: {result['store']}")


class _Rate(TextColumn):
    """Cases a second, or a minute where they are slow."""

    def __init__(self) -> None:
        super().__init__("")

    def render(self, task: Task) -> Text:
        """The present rate."""
        rate = task.speed
        if rate is None:
            return Text("")
        return Text(f"{rate:.1f}/s" if rate >= 1 else f"{60 * rate:.1f}/min")


@contextmanager
def _shown(size: int) -> "Iterator[Listener]":
    from myograph.ensemble.running.listener import Listener

    console = Console(stderr=True)
    words = TextColumn("{task.description:>28}")
    columns = (words, BarColumn(), MofNCompleteColumn(), _Rate(), TimeElapsedColumn(), TextColumn("left"), TimeLeft())
    with Progress(*columns, console=console) as progress:
        task = progress.add_task("cases", total=size)
        yield Listener(
            lambda ready: progress.update(task, completed=ready),
            lambda address: console.print(f"dashboard: {address}", highlight=False),
            lambda threads: progress.update(task, description="cases" if threads else "waiting for workers"),
        )
