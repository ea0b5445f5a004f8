"""`myograph dataset card`: the store's card, written anew and printed; its figure too, with matplotlib."""

import typer

from myograph.cli.dataset.info import Store
from myograph.cli.dataset.pictures import draw_card_figure
from myograph.cli.options import Json, print_json
from myograph.ensemble.card.text import FIGURE
from myograph.ensemble.card.writing import CARD, write_card
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import read_plan
from myograph.files import refusing


def card(store: Store, json: Json = False) -> None:
    """Write the card of a store anew, with its figure, and print it."""
    read_plan(store)
    with locked(store, 0), refusing(store):
        text = write_card(store)
        drawn = draw_card_figure(store)
    if json:
        print_json({"card": str(store / CARD), "figure": str(store / FIGURE) if drawn else None})
        return
    typer.echo(text, nl=False)
    if not drawn:
        typer.echo("myograph: no figure: it needs answered cases and  pip install 'myograph[view]'", err=True)
