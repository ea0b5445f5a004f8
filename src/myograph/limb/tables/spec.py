"""What a table of a muscle is asked to be: where its states lie, how good it must become."""

from dataclasses import asdict, dataclass, fields

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.errors import InputError
from myograph.interpolation import Basis, Domain, SparseGrid, basis
from myograph.units import radians

_LOWEST = {"level": 1, "most_states": 1, "held_out": 0, "seed": 0}


@dataclass(frozen=True)
class TableSpec:
    """How a table is built; raises InputError for numbers that make no table.

    Parameters
    ----------
    level
        Of the regular sparse grid that the table starts from.
    tolerance_mm, tolerance_nm
        Mean distance of the nodes [mm] and mean error of the moment [N·m] over the held-out states, at most.
    most_states
        The grid is not refined beyond this number of points.
    held_out
        Number of random states that are solved and not interpolated: they measure the error. With 0 nothing measures
        it: the grid is refined up to `most_states`.
    seed
        Of the held-out states.
    """

    level: int = 2
    tolerance_mm: float = 0.1
    tolerance_nm: float = 0.05
    most_states: int = 150
    held_out: int = 10
    seed: int = 0

    def __post_init__(self) -> None:
        for name, lowest in _LOWEST.items():
            if not getattr(self, name) >= lowest:
                raise InputError(f"{name}: expected at least {lowest}, got {getattr(self, name)}")
        for name in ("tolerance_mm", "tolerance_nm"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name}: expected a positive number, got {value}")
        first = len(self.start())
        if self.most_states < first:
            raise InputError(
                f"most_states: expected at least the {first} of the first grid (level {self.level}), "
                f"got {self.most_states}"
            )

    def start(self) -> SparseGrid:
        """The regular grid."""
        return SparseGrid.regular(2, self.level, boundary=BASIS.boundary)

    @property
    def most(self) -> int:
        """Number of solved states, at most."""
        return self.most_states + self.held_out

    def held_out_points(self, domain: Domain) -> Float[np.ndarray, "held_out 2"]:
        """(angle [rad], activation) of the held-out states: uniform, and the same for the same seed."""
        return domain.from_unit(np.random.default_rng(self.seed).uniform(size=(self.held_out, 2)))

    def as_dict(self) -> dict[str, float]:
        """All numbers by name."""
        return asdict(self)

    @classmethod
    def regular(cls, level: int) -> "TableSpec":
        """The regular grid of a level as it is: not refined, its error not measured."""
        return cls(level=level, most_states=len(SparseGrid.regular(2, level, BASIS.boundary)), held_out=0)


BASIS: Basis = basis("not_a_knot", 3)
"""See docs/tables.md for what others reach."""


def box(arm: Arm) -> Domain:
    """Elbow angles [rad] of the arm and activations 0 to 1."""
    low, high = (radians(bound) for bound in arm.hinge.range_deg)
    return Domain(np.array([low, 0.0]), np.array([high, 1.0]))


def spec_from(numbers: dict[str, float]) -> TableSpec:
    """The spec of `as_dict`; raises InputError for other names."""
    known = {field.name for field in fields(TableSpec)}
    if set(numbers) != known:
        raise InputError(f"expected the names {', '.join(sorted(known))}, got {', '.join(sorted(numbers))}")
    return TableSpec(**{name: type(getattr(TableSpec, name))(value) for name, value in numbers.items()})
