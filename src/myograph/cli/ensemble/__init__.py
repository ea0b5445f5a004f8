"""`myograph ensemble`: many cases, computed side by side and stored such that nothing is lost."""

import typer

from myograph.cli.ensemble.check import check
from myograph.cli.ensemble.run import resume, run
from myograph.cli.ensemble.status import status

app = typer.Typer(
    name="ensemble",
    help="Compute many cases into a store; say how far it is; check and repair it.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command()(run)
app.command()(resume)
app.command()(status)
app.command()(check)

__all__ = ["app"]
