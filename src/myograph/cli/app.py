"""The command `myograph`: its verbs, and what becomes of errors.

Exit codes: 0 done, 2 the caller's mistake, 3 a method failed, 130 interrupted. An error is one line on standard
error, or one line per wrong key of a file; never a traceback for what people can mend. So is a warning, once.
"""

import os
import sys
import warnings
from functools import cache
from typing import Annotated

import typer

import myograph
from myograph.cli.verbs import Verbs
from myograph.errors import MyographError

INTERRUPTED = 130

app = typer.Typer(
    name="myograph",
    cls=Verbs,
    help="Muscle activations in, deformed muscles out.",
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


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
        with warnings.catch_warnings():
            warnings.showwarning = _warn
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


def _warn(message: Warning | str, *_place: object) -> None:
    """What stands in the place of Python's own lines about a warning, which name a line of code."""
    _say_once(f"warning: {message}")


@cache
def _say_once(message: str) -> None:
    _say(message)


def _say(message: str) -> None:
    typer.echo(f"myograph: {message}", err=True)
