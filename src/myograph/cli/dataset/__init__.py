"""`myograph dataset`: what is in a store, its card and pictures, and its way to and from other programs."""

import typer

from myograph.cli.dataset.card import card
from myograph.cli.dataset.exporting import export
from myograph.cli.dataset.importing import import_
from myograph.cli.dataset.info import info
from myograph.cli.dataset.plot import plot

app = typer.Typer(
    name="dataset",
    help="Say what is in a store; draw it; export it to other programs, and import theirs.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command()(info)
app.command()(card)
app.command()(plot)
app.command()(export)
app.command("import")(import_)

__all__ = ["app"]
