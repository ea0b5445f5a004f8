"""The card goes to its store, and the cost of a run to its provenance; both are no part of the store's checksum."""

from pathlib import Path

from myograph.ensemble.card.facts import gather_facts
from myograph.ensemble.card.text import card_text
from myograph.ensemble.store.aside import ASIDE, place
from myograph.ensemble.store.provenance import add_provenance, provenance

CARD = "card.md"


def write_card(store: Path, name: str | None = None) -> str:
    """Write the card anew and give back its text; without a name it has the folder's.

    Raises InputError where there is no store, OSError without room.
    """
    text = card_text(gather_facts(store), name or store.resolve().name)
    (store / ASIDE).mkdir(exist_ok=True)
    place(store, store / CARD, text.encode())
    return text


def add_cost(store: Path, seconds: float) -> None:
    """Count a run that took so long [s]; raises OSError without room."""
    known = provenance(store)
    total, runs = float(known.get("seconds", 0)) + seconds, int(known.get("runs", 0)) + 1
    add_provenance(store, {"seconds": f"{total:.1f}", "runs": str(runs)})
