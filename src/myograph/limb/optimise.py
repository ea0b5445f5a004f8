r"""Activations that hold a target angle: the least of all (O1), or those nearest to what was before (O2).

    O1  min Σ_i a_i            O2  min Σ_i (a_i - b_i)²         with  M(θ, a) = 0  and  0 ≤ a_i ≤ 1

The muscles' moments are not linear in the activations, so that there may be several local minima: SLSQP, with exact
gradients, starts from many places, above all from those where one muscle alone holds the load. Stable equilibria come
first, however little an unstable one would cost: where the least is unstable, the search is repeated with ∂M/∂θ held
below a small bound.
Source: Valentin, Sprenger, Pflüger, Röhrle 2018.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.optimize import minimize, root_scalar

from myograph.errors import InputError, NotConvergedError
from myograph.limb.limb import Limb
from myograph.limb.reach import in_words, moment_bounds, reachable_angles
from myograph.units import degrees, newton_metres

BALANCED = 1e-8
"""Largest net moment of a solution, over the range of moments that the muscles can make there."""
STABLE = 0.01
"""Least fall of the net moment with the angle, over the range of moments, in the repeated search [1/rad]."""
SNAP = 1e-10
"""Activations nearer than this to 0 or 1 are 0 or 1."""
SCATTERED = 7
"""Starting points that are scattered over all activations, the same in every run."""

Vector = Float[np.ndarray, " muscles"]


@dataclass(frozen=True)
class Target:
    """An angle [rad] to hold with a weight [N] in the hand; with `previous` activations, O2 instead of O1."""

    angle: float
    hand_load: float = 0.0
    previous: tuple[float, ...] | None = None


@dataclass(frozen=True)
class Optimum:
    """Activations that hold a target.

    Parameters
    ----------
    cost
        Sum of the activations (O1), or the Euclidean norm of their change (O2).
    imbalance
        Net moment that is left at the target [N*mm].
    stable
        Whether the elbow returns to the target when pushed.
    sensitivity
        How the angle moves with each activation [rad].
    """

    target: Target
    muscles: tuple[str, ...]
    activations: tuple[float, ...]
    cost: float
    imbalance: float
    stable: bool
    sensitivity: tuple[float, ...]
    notes: tuple[str, ...] = field(default=())


def optimise(limb: Limb, target: Target) -> Optimum:
    """The best activations that hold the target.

    Raises InputError for a target outside the range or out of reach, naming what can be reached, and NotConvergedError
    where no start leads to a balance.
    """
    if target.previous is not None:
        limb.check(target.previous, target.hand_load)
    low, high = _require_reachable(limb, target)
    problem = _Problem(limb, target, high - low)
    found = problem.minima(must_be_stable=False)
    if not found:
        raise NotConvergedError(
            f"no activations found that hold {degrees(target.angle):g} degrees with {target.hand_load:g} N,"
            " although the muscles' moments allow it"
        )
    if problem.slope(found[0]) < 0:
        return problem.optimum(found[0], found[0], stable=True)
    stable = [one for one in (*problem.minima(must_be_stable=True), *found) if problem.slope(one) < 0]
    return problem.optimum(min(stable, key=problem.cost, default=found[0]), found[0], bool(stable))


@dataclass(frozen=True)
class _Problem:
    """One target, its constraint scaled by the range of moments."""

    limb: Limb
    target: Target
    scale: float

    def objective(self, a: Vector) -> tuple[float, Vector]:
        if self.target.previous is None:
            return float(a.sum()), np.ones_like(a)
        change = a - np.array(self.target.previous)
        return float(change @ change), 2 * change

    def cost(self, a: Vector) -> float:
        value = self.objective(a)[0]
        return value if self.target.previous is None else float(np.sqrt(value))

    def balance(self, a: Vector) -> tuple[float, Vector]:
        moment, _, gradient = self.limb.moment_gradient(a.tolist(), self.target.hand_load, self.target.angle)
        return moment / self.scale, gradient / self.scale

    def slope(self, a: Vector) -> float:
        return self.limb.moment_gradient(a.tolist(), self.target.hand_load, self.target.angle)[1]

    def starts(self) -> list[Vector]:
        """The previous activations, one muscle alone, one muscle added to all others' rest, and scattered points."""
        count = len(self.limb.muscles)
        base = np.zeros(count) if self.target.previous is None else np.array(self.target.previous)
        alone = [one for k in range(count) if (one := self._by_one(base, k)) is not None]
        corners = [np.where(np.arange(count) == k, 1.0, base) for k in range(count)]
        scattered = np.random.default_rng(0).random((SCATTERED, count))
        return [*alone, base, *corners, *scattered]

    def _by_one(self, base: Vector, k: int) -> Vector | None:
        """The base with muscle k so active that all balances, where it can."""

        def with_level(level: float) -> Vector:
            return np.where(np.arange(len(base)) == k, level, base)

        ends = self.balance(with_level(0.0))[0], self.balance(with_level(1.0))[0]
        if ends[0] * ends[1] > 0:
            return None
        found = root_scalar(lambda level: self.balance(with_level(level))[0], bracket=(0.0, 1.0), xtol=1e-12)
        return with_level(float(found.root))

    def minima(self, must_be_stable: bool) -> list[Vector]:
        """Local minima from all starts, the cheapest first."""
        found = (self.solve(start, must_be_stable) for start in self.starts())
        return sorted((one for one in found if one is not None), key=self.cost)

    def solve(self, start: Vector, must_be_stable: bool) -> Vector | None:
        """A local minimum from a start; None where the search ends out of balance."""
        balance: dict[str, Any] = {
            "type": "eq",
            "fun": lambda a: self.balance(_in_box(a))[0],
            "jac": lambda a: self.balance(_in_box(a))[1],
        }
        falls: dict[str, Any] = {"type": "ineq", "fun": lambda a: -self.slope(_in_box(a)) / self.scale - STABLE}
        result = minimize(
            lambda a: self.objective(_in_box(a)),
            start,
            jac=True,
            method="SLSQP",
            bounds=[(0.0, 1.0)] * len(start),
            constraints=[balance, falls] if must_be_stable else [balance],
            options={"ftol": 1e-12, "maxiter": 100},
        )
        found = _snapped(self._balanced(_in_box(result.x)))
        return found if abs(self.balance(found)[0]) <= BALANCED else None

    def _balanced(self, a: Vector) -> Vector:
        """Close the rest of the balance along its gradient, inside the bounds."""
        for _ in range(5):
            value, gradient = self.balance(a)
            free = ~(((a <= 0) & (value * gradient > 0)) | ((a >= 1) & (value * gradient < 0)))
            step = np.where(free, gradient, 0.0)
            if abs(value) < 1e-14 or not step.any():
                break
            a = _in_box(a - value * step / (step @ step))
        return a

    def optimum(self, best: Vector, cheapest: Vector, stable: bool) -> Optimum:
        notes = ()
        if not stable:
            notes = ("the equilibrium is unstable: the elbow leaves it when pushed",)
        elif self.cost(cheapest) < self.cost(best) - 1e-6:
            notes = (f"a cost of {self.cost(cheapest):.4g} would hold the target too, but not stably",)
        return Optimum(
            self.target,
            self.limb.names,
            tuple(best.tolist()),
            self.cost(best),
            self.balance(best)[0] * self.scale,
            stable,
            tuple(self.limb.sensitivity(best.tolist(), self.target.hand_load, self.target.angle).tolist()),
            notes,
        )


def _require_reachable(limb: Limb, target: Target) -> tuple[float, float]:
    """Least and largest moment of the muscles at the target; raises InputError where these do not balance the rest."""
    if not limb.low <= target.angle <= limb.high:
        raise InputError(
            f"target: expected {degrees(limb.low):g} to {degrees(limb.high):g} degrees, got {degrees(target.angle):g}"
        )
    limb.check((0.0,) * len(limb.muscles), target.hand_load)
    angle = np.array([target.angle])
    low, high = (float(bound) for bound in moment_bounds(limb, angle)[0])
    needed = -float(limb.outside(angle, target.hand_load)[0])
    slack = 1e-9 * (high - low)
    if not low - slack <= needed <= high + slack:
        raise InputError(
            f"{degrees(target.angle):g} degrees with {target.hand_load:g} N in the hand is out of reach: it needs"
            f" {newton_metres(needed):.2f} N·m of the muscles, which give {newton_metres(low):.2f} to"
            f" {newton_metres(high):.2f} there; reachable with this load: "
            f"{in_words(reachable_angles(limb, target.hand_load))} degrees"
        )
    return low, high


def _snapped(a: Vector) -> Vector:
    """A rounding error inside a bound is on it."""
    return np.where(a < SNAP, 0.0, np.where(a > 1 - SNAP, 1.0, a))


def _in_box(a: Sequence[float] | Vector) -> Vector:
    return np.clip(np.asarray(a, dtype=float), 0.0, 1.0)
