"""One muscle over the whole box of elbow angle and activation: solved states on a sparse grid, smooth in between.

The fields of all states are compressed to few modes (`TOLERANCES`); their coefficients, and the moment by itself, are
interpolated by B-splines on the sparse grid. A value between the points is one small matrix-vector product.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int, Shaped

from myograph.errors import NotConvergedError
from myograph.fields import von_mises
from myograph.interpolation import Domain, Hierarchizer, Interpolant, Modes, SparseGrid, compress
from myograph.interpolation.section import Section
from myograph.limb.spline_moment import SplineMoment
from myograph.limb.tables.held_out import HeldOut
from myograph.limb.tables.spec import BASIS, TableSpec
from myograph.limb.tables.state import FIELDS_IN_TABLE, State
from myograph.units import degrees

TOLERANCES = {"position": 1e-3, "cauchy_stress": 1e-4, "fibre_stretch": 1e-5, "pressure": 1e-4}
"""Largest error of an entry by compression (mm, MPa, 1, MPa): a fiftieth or less of what interpolation makes."""
_BEFORE_ROUNDING = 0.95
"""Share of the tolerances that compression may use; the rest is for modes in single precision."""


@dataclass(frozen=True)
class Record:
    """How each state was solved; the meaning of the numbers is that of `State`, NaN where one failed."""

    newton_steps: Int[np.ndarray, " points"]
    volume_change: Float[np.ndarray, " points"]
    smallest_jacobian: Float[np.ndarray, " points"]
    penetration: Float[np.ndarray, " points"]
    seconds: Float[np.ndarray, " points"]
    failures: Shaped[np.ndarray, " points"]


@dataclass(frozen=True, eq=False)
class MuscleTable:
    """States of one muscle at the points of a sparse grid; a `MuscleMoment`.

    Parameters
    ----------
    muscle, preset, spec
        Which muscle on which mesh, and what was asked of the table.
    key
        Checksum of all that the table depends on.
    domain, grid
        Angles [rad] and activations, and the points in them.
    moments
        About the hinge [N*mm]; NaN where a state failed.
    modes
        Field name -> mean, modes and their coefficients at the points.
    reference, skin
        Nodes in the reference body [mm] and the quadrilaterals of the surface.
    record
        How each state was solved.
    held_out
        The table against states that it does not hold.
    provenance
        Versions and checksums, in words.
    """

    muscle: str
    preset: str
    spec: TableSpec
    key: str
    domain: Domain
    grid: SparseGrid
    moments: Float[np.ndarray, " points"]
    modes: Mapping[str, Modes]
    reference: Float[np.ndarray, "nodes 3"]
    skin: Int[np.ndarray, "quads 4"]
    record: Record
    held_out: HeldOut
    provenance: Mapping[str, str]

    @property
    def size(self) -> int:
        """Number of states in the table."""
        return len(self.grid)

    @cached_property
    def points(self) -> Float[np.ndarray, "points 2"]:
        """(angle [rad], activation) of the states."""
        return self.domain.from_unit(self.grid.coordinates(BASIS))

    @property
    def met(self) -> bool | None:
        """Whether the errors on the held-out states are within the asked tolerances; None where nobody measured."""
        if not len(self.held_out.points):
            return None
        return self.held_out.within(self.spec.tolerance_mm, self.spec.tolerance_nm)

    @property
    def failures(self) -> int:
        """Number of states that failed."""
        return int(np.count_nonzero(self.record.failures != ""))

    def require_complete(self) -> None:
        """Raise NotConvergedError, with the number of failed states, their places and the first reason, if any are."""
        if self.failures:
            failed = np.flatnonzero(self.record.failures != "")
            places = ", ".join(f"({degrees(angle):.1f}°, {a:.3g})" for angle, a in self.points[failed[:5]].tolist())
            more = ", ..." if len(failed) > 5 else ""
            raise NotConvergedError(
                f"{self.muscle}: {len(failed)} of {self.size} states failed, at (angle, activation) {places}{more};"
                f" the first: {self.record.failures[failed[0]]}"
            )

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad]; raises InputError outside the box."""
        return self.spline_moment.moment(angles, activation)

    def moment_gradient(self, angle: float, activation: float) -> tuple[float, float, float]:
        """M [N*mm], dM/dangle [N*mm/rad] and dM/dactivation [N*mm]: exact derivatives of `moment`."""
        return self.spline_moment.moment_gradient(angle, activation)

    def curve(self, activation: float) -> Section:
        """The moment over the angle alone, prepared for many values."""
        return self.spline_moment.curve(activation)

    def field(self, name: str, angle: float, activation: float) -> Float[np.ndarray, "nodes ..."]:
        """One node field (see `myograph.fields`) at an angle [rad]; raises InputError outside the box."""
        return self.at(angle, activation)[name]

    def at(self, angle: float, activation: float) -> "NodeFields":
        """All node fields at an angle [rad], by name; each is computed when it is first asked for."""
        return NodeFields(self, self.coefficients(np.array([angle, activation])))

    def expanded(self, name: str, coefficients: Float[np.ndarray, " modes"]) -> Float[np.ndarray, "nodes ..."]:
        """One stored field from the coefficients of the modes of all of them."""
        shape = (len(self.reference), *FIELDS_IN_TABLE[name])
        return self.modes[name].expand(coefficients[self._columns[name]]).reshape(shape)

    @cached_property
    def _columns(self) -> dict[str, slice]:
        """Which coefficients are a field's."""
        ends = np.cumsum([len(self.modes[name].vectors) for name in FIELDS_IN_TABLE]).tolist()
        return {name: slice(a, b) for name, a, b in zip(FIELDS_IN_TABLE, [0, *ends[:-1]], ends, strict=True)}

    @cached_property
    def _hierarchizer(self) -> Hierarchizer:
        self.require_complete()
        return Hierarchizer(self.grid, BASIS, self.domain)

    @cached_property
    def spline_moment(self) -> SplineMoment:
        """The moment [N*mm] as a spline over (angle, activation)."""
        return SplineMoment(self._hierarchizer.interpolant(self.moments))

    @cached_property
    def coefficients(self) -> Interpolant:
        """Coefficients of the modes of all fields, one field after the other."""
        values = [self.modes[name].coefficients for name in FIELDS_IN_TABLE]
        return self._hierarchizer.interpolant(np.concatenate(values, axis=1))

    def surpluses(self) -> Float[np.ndarray, "points numbers"]:
        """Hierarchical surpluses over the tolerances: root mean square of the nodes' shifts, and the moment."""
        shifts = self.coefficients.surpluses[:, self._columns["position"]] / np.sqrt(len(self.reference))
        moments = self.spline_moment.interpolant.surpluses.reshape(-1, 1) / 1000
        return np.concatenate([shifts / self.spec.tolerance_mm, moments / self.spec.tolerance_nm], axis=1)


@dataclass(frozen=True, eq=False)
class NodeFields(Mapping[str, np.ndarray]):
    """The node fields of one state of a table; the von Mises stress follows from the interpolated stress."""

    table: MuscleTable
    coefficients: Float[np.ndarray, " modes"]

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._ready:
            stress = name == "von_mises"
            self._ready[name] = von_mises(self["cauchy_stress"]) if stress else self._stored(name)
        return self._ready[name]

    def __iter__(self) -> Iterator[str]:
        return iter((*FIELDS_IN_TABLE, "von_mises"))

    def __len__(self) -> int:
        return len(FIELDS_IN_TABLE) + 1

    def _stored(self, name: str) -> np.ndarray:
        if name not in FIELDS_IN_TABLE:
            raise KeyError(name)
        return self.table.expanded(name, self.coefficients)

    @cached_property
    def _ready(self) -> dict[str, np.ndarray]:
        return {}


def compressed(states: Sequence[State], nodes: int) -> dict[str, Modes]:
    """Modes of all fields of the solved states; coefficients of failed ones are NaN."""
    solved = np.array([not state.failure for state in states])
    modes = {}
    for name, rest in FIELDS_IN_TABLE.items():
        width = nodes * int(np.prod(rest, dtype=int))
        values = [state.fields[name].reshape(width) for state in states if not state.failure]
        found = compress(np.stack(values) if values else np.zeros((1, width)), _BEFORE_ROUNDING * TOLERANCES[name])
        coefficients = np.full((len(states), found.coefficients.shape[1]), np.nan)
        coefficients[solved] = found.coefficients[: solved.sum()]
        modes[name] = Modes(found.mean, found.vectors, coefficients, found.largest_error).rounded()
    return modes


def recorded(states: Sequence[State]) -> Record:
    """How the states were solved."""
    floats = ("volume_change", "smallest_jacobian", "penetration", "seconds")
    columns = {name: np.array([float(getattr(state, name)) for state in states]) for name in floats}
    steps = np.array([state.newton_steps for state in states], dtype=np.int64)
    return Record(newton_steps=steps, failures=np.array([state.failure for state in states]), **columns)
