"""The command `myograph`: its verbs, and what becomes of errors.

Exit codes: 0 done, 2 the caller's mistake, 3 a method failed, 130 interrupted. An error is one line on standard
error, or one line per wrong key of a file; never a traceback for what people can mend.
"""

import os
import sys
from typing import Annotated

import typer

import myograph
from myograph.cli.arm import arm
from myograph.cli.bench import app as bench_app
from myograph.cli.dataset import app as dataset_app
from myograph.cli.demo import demo
from myograph.cli.ensemble import app as ensemble_app
from myograph.cli.evaluate import evaluate
from myograph.cli.move import move
from myograph.cli.optimise import optimise
from myograph.cli.predict import predict
from myograph.cli.solve import solve
from myograph.cli.table import app as table_app
from myograph.cli.train import train
from myograph.cli.verify import verify
from myograph.errors import MyographError

INTERRUPTED = 130

app = typer.Typer(
    name="myograph",
    help="Muscle activations in, deformed muscles out.",
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
app.command()(demo)
app.command()(arm)
app.command()(solve)
app.command()(optimise)
app.command()(move)
app.command()(verify)
app.command()(train)
app.command()(predict)
app.command()(evaluate)
app.add_typer(table_app)
app.add_typer(ensemble_app)
app.add_typer(dataset_app)
app.add_typer(bench_app)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"myograph {myograph.__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Muscle activations in, deformed muscles out."""


def main() -> None:
    """Run the command line and leave with its exit code."""
    try:
        code = app(standalone_mode=False)
    except MyographError as error:
        _say(str(error))
        sys.exit(error.exit_code)
    except typer.TyperException as error:
        _say(f"{error.format_message()}; see 'myograph --help'")
        sys.exit(2)
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    if code == INTERRUPTED:
        _leave_interrupted()
    sys.exit(code if isinstance(code, int) else 0)


def _leave_interrupted() -> None:
    """Leave at once: what Python does on its way out can be interrupted too, and would change the exit code."""
    _say("interrupted; nothing is half-written")
    sys.stdout.flush()
    os._exit(INTERRUPTED)


def _say(message: str) -> None:
    typer.echo(f"myograph: {message}", err=True)
