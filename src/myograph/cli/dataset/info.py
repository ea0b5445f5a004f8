"""`myograph dataset info`: what is in a store."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.cli.options import Json, print_json
from myograph.ensemble.card.facts import StoreFacts, gather_facts
from myograph.ensemble.card.ranges import Range
from myograph.fields import FIELDS
from myograph.units import degrees

Store = Annotated[Path, typer.Argument(help="Folder of the store.")]


def info(store: Store, json: Json = False) -> None:
    """Say how many cases are done, of which muscles, how far their fields reach, and the size on disk."""
    facts = gather_facts(store, None)
    if json:
        print_json(describe(store, facts))
        return
    plan = facts.plan
    typer.echo(f"{store}: {plan.size} cases, {facts.done} done, {facts.failed} failed, {facts.missing} missing")
    typer.echo(f"  simulator  {plan.simulator.kind} {plan.simulator.preset}".rstrip())
    typer.echo("  designs    " + ", ".join(f"{word} {count}" for word, count in facts.designs.items()))
    if facts.angle:
        typer.echo(f"  elbow      {degrees(facts.angle.least):.1f} to {degrees(facts.angle.largest):.1f} degrees")
    for muscle, fields in facts.fields.items():
        typer.echo(f"  {muscle}, {plan.nodes[muscle]} nodes")
        for name, found in fields.items():
            reach = f"{found.least:10.4g} to {found.largest:10.4g}, mean {found.mean:10.4g}"
            typer.echo(f"    {name:15s} {reach} {_unit(name)}".rstrip())
    typer.echo(f"  fields     {', '.join(plan.fields)}: {facts.stored / 1e6:.1f} MB, compressed to {_ratio(facts):.2f}")
    if facts.unreadable:
        typer.echo(f"  {facts.unreadable} cases of a muscle cannot be read; see 'myograph ensemble check'")
    for key, value in facts.provenance.items():
        typer.echo(f"  {key.replace('_', ' '):10s} {value}")


def describe(store: Path, facts: StoreFacts) -> dict[str, Any]:
    """What `--json` prints."""
    plan = facts.plan
    return {
        "store": str(store),
        "cases": plan.size,
        "done": facts.done,
        "failed": facts.failed,
        "missing": facts.missing,
        "reasons": dict(facts.reasons),
        "designs": dict(facts.designs),
        "simulator": dict(plan.described),
        "elbow_angle_deg": _numbers(facts.angle, degrees) if facts.angle else None,
        "stored": list(plan.fields),
        "muscles": {
            muscle: {
                "nodes": plan.nodes[muscle],
                "fields": {name: {"unit": _unit(name) or "1", **_numbers(found)} for name, found in fields.items()},
            }
            for muscle, fields in facts.fields.items()
        },
        "bytes": facts.stored,
        "compression": _ratio(facts),
        "unreadable": facts.unreadable,
        "provenance": dict(facts.provenance),
    }


def _ratio(facts: StoreFacts) -> float:
    """Size on disk over that in float32; 1 where there is nothing."""
    return facts.stored / facts.raw if facts.raw else 1.0


def _numbers(found: Range, of: Callable[[float], float] = float) -> dict[str, float]:
    return {name: of(value) for name, value in vars(found).items()}


def _unit(name: str) -> str:
    unit = FIELDS[name].unit if name in FIELDS else "mm"
    return "" if unit == "1" else unit
