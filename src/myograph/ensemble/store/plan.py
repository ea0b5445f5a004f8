"""What a store holds: fixed when it is made, checked whenever it is opened."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from myograph.case import Case
from myograph.ensemble.design.cases import Design
from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.checksum import checksum
from myograph.errors import InputError

SCHEMA = 2
"""Version of the layout on disk."""
PLAN = "ensemble.json"


@dataclass(frozen=True)
class StorePlan:
    """The cases of a store and how they are answered.

    Parameters
    ----------
    design
        All cases, in their order.
    simulator
        How to make the simulator on a worker.
    described
        What its answers depend on (`describe_simulator`).
    muscles
        Whose fields are stored.
    nodes
        Number of nodes of each of them.
    still
        Path in the store -> checksum, of every file that never changes.
    fields
        Names of the fields that are stored of every muscle; an imported store may have fewer than a simulated one.
    """

    design: Design
    simulator: SimulatorSpec
    described: Mapping[str, Any]
    muscles: tuple[str, ...]
    nodes: Mapping[str, int]
    still: Mapping[str, str]
    fields: tuple[str, ...] = NODE_FIELDS

    @property
    def size(self) -> int:
        """Number of cases."""
        return len(self.design.cases)

    @property
    def arrays(self) -> tuple[tuple[str, str], ...]:
        """Muscle and field of every array that has a chunk for each answered case."""
        return tuple((muscle, field) for muscle in self.muscles for field in self.fields)

    @property
    def identity(self) -> str:
        """Checksum of what is asked; a store is continued only by a run that asks the same."""
        asked = [SCHEMA, _cases(self.design), dict(self.described), self.muscles, dict(self.nodes)]
        return checksum(_text(asked if self.fields == NODE_FIELDS else [*asked, self.fields]))

    def with_still(self, still: Mapping[str, str]) -> "StorePlan":
        """The plan with the checksums of the files that never change."""
        return replace(self, still=dict(still))


def plan_bytes(plan: StorePlan) -> bytes:
    """The plan as the bytes of its file; its own checksum is the last entry.

    Where the tables lie is no part of it: see `myograph.ensemble.store.tables`.
    """
    body = {
        "schema": SCHEMA,
        "identity": plan.identity,
        "simulator": {**asdict(plan.simulator), "tables": None},
        "described": dict(plan.described),
        "muscles": list(plan.muscles),
        "nodes": dict(plan.nodes),
        "fields": list(plan.fields),
        "still": dict(sorted(plan.still.items())),
        "cases": _cases(plan.design),
    }
    return _text({**body, "checksum": checksum(_text(body))})


def read_plan(store: Path) -> StorePlan:
    """The plan of a store; raises InputError where there is no store, a damaged one, or one of another schema."""
    path = store / PLAN
    try:
        body = json.loads(path.read_bytes())
        found = body.pop("checksum")
        schema = body["schema"]
    except FileNotFoundError:
        raise InputError(f"{store}: expected the store of an ensemble, found none; make one with 'run'") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as problem:
        raise InputError(f"{path}: damaged ({problem}); run the ensemble into a new store") from None
    if schema != SCHEMA:
        raise InputError(f"{path}: expected schema {SCHEMA}, got {schema!r}; run the ensemble into a new store")
    if checksum(_text(body)) != found:
        raise InputError(f"{path}: damaged (its checksum is wrong); run the ensemble into a new store")
    cases = tuple(Case(tuple(row[0]), row[1], row[2]) for row in body["cases"])
    return StorePlan(
        Design(cases, tuple(row[3] for row in body["cases"])),
        SimulatorSpec(**body["simulator"]),
        body["described"],
        tuple(body["muscles"]),
        body["nodes"],
        body["still"],
        tuple(body.get("fields", NODE_FIELDS)),
    )


def _cases(design: Design) -> list[Any]:
    return [
        [list(case.activations), case.hand_load, case.elbow_angle, word]
        for case, word in zip(design.cases, design.words, strict=True)
    ]


def _text(data: Any) -> bytes:
    """JSON with numbers that come back exactly; NaN is refused."""
    return json.dumps(data, allow_nan=False, ensure_ascii=False).encode()
