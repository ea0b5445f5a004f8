"""Options that several verbs share, and how they print."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.anatomy.load import built_in_arm, load_arm
from myograph.anatomy.model import Arm

Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Preset = Annotated[str, typer.Option(help="Size: tiny (150 nodes a muscle), quick (1,000) or thesis (4,000).")]
ArmFile = Annotated[
    Path | None, typer.Option("--arm", help="TOML file of another arm; without it the built-in left arm.")
]


def read_arm(path: Path | None) -> Arm:
    """The arm of the file, or the built-in one."""
    return built_in_arm() if path is None else load_arm(path)


def print_json(data: dict[str, Any]) -> None:
    """Print one object on standard output."""
    typer.echo(json.dumps(data))
