"""How far fields reach: their least, mean and largest value over nodes and cases, read one case at a time."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.store.chunks import read_chunk
from myograph.ensemble.store.opening import readable_row
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.reading import read_body
from myograph.errors import InputError
from myograph.fields import FIELDS


@dataclass(frozen=True)
class Range:
    """Least, mean and largest of some numbers."""

    least: float
    mean: float
    largest: float


@dataclass(frozen=True)
class MuscleScalars:
    """The scalar fields of a muscle in a store, and `displacement`: the distance [mm] from the reference body."""

    store: Path
    plan: StorePlan
    muscle: str
    reference: Float[np.ndarray, "nodes 3"]

    @property
    def names(self) -> tuple[str, ...]:
        """What there is."""
        return ("displacement", *(name for name in self.plan.fields if not FIELDS[name].components))

    def read(self, case: int, names: Sequence[str]) -> dict[str, Float[np.ndarray, " nodes"]]:
        """Some of them in one case; raises InputError where a chunk is not what was written."""
        row, nodes, found = readable_row(self.store, case), self.plan.nodes[self.muscle], {}
        for name in names:
            moved = name == "displacement"
            array = f"{self.muscle}/{'position' if moved else name}"
            values = read_chunk(self.store, array, case, row.chunks.get(array, "") if row else "", nodes)
            found[name] = np.linalg.norm(values - self.reference, axis=1) if moved else values
        return found


def muscle_scalars(store: Path, plan: StorePlan, muscle: str) -> MuscleScalars:
    """The scalar fields of a muscle; raises InputError where its reference body is not what was written."""
    return MuscleScalars(store, plan, muscle, read_body(store, plan, muscle).reference)


def ranges(scalars: MuscleScalars, cases: Iterable[int], names: Sequence[str]) -> tuple[Mapping[str, Range], int]:
    """The range of each field over some cases, and how many of them could not be read."""
    rows: list[list[tuple[float, float, float]]] = []
    unreadable = 0
    for case in cases:
        try:
            found = scalars.read(case, names)
        except InputError:
            unreadable += 1
            continue
        rows.append([(float(v.min()), float(v.mean(dtype=float)), float(v.max())) for v in found.values()])
    if not rows:
        return {}, unreadable
    low, middle, high = np.moveaxis(np.array(rows), 2, 0)
    columns = zip(low.min(axis=0).tolist(), middle.mean(axis=0).tolist(), high.max(axis=0).tolist(), strict=True)
    return {name: Range(*three) for name, three in zip(names, columns, strict=True)}, unreadable


def distribution(
    scalars: MuscleScalars, groups: Mapping[str, Sequence[int]], name: str, bins: int
) -> tuple[Float[np.ndarray, " edges"], dict[str, Int[np.ndarray, " bins"]]]:
    """How often the values of a field occur, group by group of cases: ends of the classes, and counts.

    Raises InputError where a chunk is not what was written.
    """
    reach = [
        (v.min(), v.max()) for cases in groups.values() for case in cases for v in scalars.read(case, [name]).values()
    ]
    low, high = (float(of(ends)) for of, ends in zip((np.min, np.max), np.transpose(reach), strict=True))
    edges = np.linspace(low, high if high > low else low + 1, bins + 1)
    counts = {
        word: sum((np.histogram(scalars.read(case, [name])[name], edges)[0] for case in cases), np.zeros(bins, int))
        for word, cases in groups.items()
    }
    return edges, counts
