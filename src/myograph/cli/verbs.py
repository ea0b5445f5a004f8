"""The verbs and where each lives; a verb's module is read when the verb is asked for.

So `myograph --version` does not wait for what `train` needs, and `--help` alone reads them all.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup
from typer.main import get_command

VERBS = {
    "demo": "myograph.cli.demo",
    "arm": "myograph.cli.arm",
    "solve": "myograph.cli.solve",
    "optimise": "myograph.cli.optimise",
    "move": "myograph.cli.move",
    "verify": "myograph.cli.verify",
    "table": "myograph.cli.table",
    "ensemble": "myograph.cli.ensemble",
    "dataset": "myograph.cli.dataset",
    "train": "myograph.cli.train",
    "predict": "myograph.cli.predict",
    "evaluate": "myograph.cli.evaluate",
    "reproduce": "myograph.cli.reproduce",
    "bench": "myograph.cli.bench",
    "view": "myograph.cli.view",
    "picture": "myograph.cli.picture",
    "film": "myograph.cli.film",
    "export": "myograph.cli.export",
}
"""Verb -> module with a function of its name, or with an `app` of several."""


class _Commands(Mapping[str, Any]):
    """Verb -> its command, made when it is looked up."""

    def __getitem__(self, name: str) -> Any:
        if name not in VERBS:
            raise KeyError(name)
        return _command(name)

    def __iter__(self) -> Iterator[str]:
        return iter(VERBS)

    def __len__(self) -> int:
        return len(VERBS)


class Verbs(TyperGroup):
    """A group whose commands are `VERBS`."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.commands = _Commands()  # pyright: ignore[reportAttributeAccessIssue]

    def list_commands(self, ctx: Any) -> list[str]:
        """Names in the order of `VERBS`."""
        return list(VERBS)


@cache
def _command(name: str) -> Any:
    module = import_module(VERBS[name])
    app = getattr(module, "app", None)
    if app is None:
        app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
        app.command(name)(getattr(module, name))
    return get_command(app)
