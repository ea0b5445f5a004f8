"""From one solved state of a muscle to another: steps that are cut back on failure and grown on success.

A path of controls leads from state to state: first the pre-stretch is ramped up in the reference pose, then the angle
changes at rest, then the activation jumps. Every step starts from the last solved one; a turn of the elbow, from the
parabola through the last two. A step that leads through a bone, where the energy has further minima, is none.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from myograph.errors import NotConvergedError, SolvePoint
from myograph.mechanics.newton import NewtonResult, newton, smallest_volume_ratio
from myograph.mechanics.predictor import extrapolated, flexion_rate
from myograph.mechanics.problem import MuscleProblem
from myograph.mechanics.soundness import depths_in_obstacles
from myograph.units import degrees, radians

LARGEST_TURN = radians(20.0)
SMALLEST_SHARE = 1 / 128
DEEPEST = 1.0
"""Depth [mm] in a bone from which on a muscle has passed into it instead of leaning on it."""
_FIRST_SHARES = (1 / 8, 1 / 16, 1 / 32)
"""First steps on the way to rest, as shares of it."""
_CRUSHED = 0.1
"""Smallest J at rest, below which an element counts as crushed."""
_QUICK = 4
"""Newton steps up to which a load step was easy and the next may be three times as long."""


@dataclass(frozen=True)
class Controls:
    """Ramp of the pre-stretch (0 to 1), activation, flexion from the reference pose [rad]."""

    ramp: float
    activation: float
    flexion: float

    def towards(self, target: "Controls", share: float) -> "Controls":
        """Controls on the straight way to the target."""
        first, last = np.array(self.values()), np.array(target.values())
        return Controls(*map(float, first + share * (last - first)))

    def values(self) -> tuple[float, float, float]:
        """All three, in order."""
        return self.ramp, self.activation, self.flexion


@dataclass(frozen=True)
class Solved:
    """A solved state.

    Parameters
    ----------
    controls, vector
        Where, and the unknowns.
    newton_steps
        Tangents that were assembled and factored on the way from the state before.
    rate, turn
        Of the last turn of the elbow: the rate of the unknowns where it began [per rad], and its size [rad].
    """

    controls: Controls
    vector: Float[np.ndarray, " unknowns"]
    newton_steps: int
    rate: Float[np.ndarray, " unknowns"] | None = None
    turn: float = 0.0


def unloaded(problem: MuscleProblem) -> Solved:
    """The reference body: no pre-stretch, no activation, reference pose."""
    return Solved(Controls(0.0, 0.0, 0.0), np.zeros(problem.vector_size), 0)


def at_rest(problem: MuscleProblem) -> Solved:
    """The muscle in the reference pose with its full pre-stretch, not activated.

    A step too long can crush an element into another minimum of the energy. Where one is all but crushed, shorter
    first steps are tried; if it always is, the state of least energy is the answer.
    """
    found = []
    for first_share in _FIRST_SHARES:
        state = reach(problem, unloaded(problem), Controls(1.0, 0.0, 0.0), first_share)
        if smallest_volume_ratio(problem, state.vector) > _CRUSHED:
            return state
        found.append((problem.energy(state.vector), state))
    return min(found, key=lambda tried: tried[0])[1]


def reach(
    problem: MuscleProblem, start: Solved, target: Controls, first_share: float = 1.0, most: int | None = None
) -> Solved:
    """Solve at `target`, from `start`, with `most` tangents or a few more.

    Raises NotConvergedError with the place and the residuals where even the smallest step does not lead on, or where
    the tangents are used up.
    """
    if start.controls == target:
        return start
    turn = abs(target.flexion - start.controls.flexion)
    share = min(first_share, LARGEST_TURN / turn if turn > LARGEST_TURN else 1.0)
    done, steps, here = 0.0, 0, start
    rate: np.ndarray | None = None
    while done < 1:
        share = min(share, 1 - done)
        controls = start.controls.towards(target, done + share)
        if rate is None and controls.flexion != here.controls.flexion:
            set_controls(problem, here.controls)
            rate, steps = flexion_rate(problem, here.vector, here.controls.flexion), steps + 1
        result = _step(problem, here, controls, rate)
        steps += result.tangents
        if not result.failure:
            turned = controls.flexion - here.controls.flexion
            memory = (rate, turned) if rate is not None else (here.rate, here.turn)
            here, rate = Solved(controls, result.vector, steps, *memory), None
            done = 1.0 if done + share > 1 - 1e-9 else done + share
            share *= 3.0 if result.tangents <= _QUICK else 1.5
        elif most is not None and steps > most:
            raise _failure(problem, controls, f"not reached with {most} tangents", result.residuals)
        elif share / 2 < SMALLEST_SHARE:
            raise _failure(problem, controls, result.failure, result.residuals)
        else:
            share /= 2
    return replace(here, controls=target, newton_steps=steps)


def settled(problem: MuscleProblem, guess: Float[np.ndarray, " unknowns"], target: Controls) -> Solved:
    """Solve at `target` straight from a guess of all unknowns.

    Raises NotConvergedError with the place and the residuals where Newton's method does not lead there.
    """
    result = _step(problem, Solved(target, guess, 0), target, None)
    if result.failure:
        raise _failure(problem, target, result.failure, result.residuals)
    return Solved(target, result.vector, result.tangents)


def _step(problem: MuscleProblem, here: Solved, controls: Controls, rate: np.ndarray | None) -> NewtonResult:
    """One load step; with a rate, along the parabola."""
    guess = here.vector
    if rate is not None:
        guess = guess + extrapolated(rate, here.rate, controls.flexion - here.controls.flexion, here.turn)
    set_controls(problem, controls)
    held = np.where(problem.free, 0.0, guess)
    result = newton(problem, guess, problem.boundary_values(controls.flexion) - held)
    return replace(result, failure=result.failure or _through_a_bone(problem, result.vector, controls))


def _through_a_bone(problem: MuscleProblem, vector: np.ndarray, controls: Controls) -> str:
    """Which of the bones that push it the muscle went into, and how deep; nothing before they push fully."""
    if controls.ramp < 1:
        return ""
    depths = depths_in_obstacles(problem, vector, controls.flexion)
    worst = max(depths, key=lambda name: depths[name], default="")
    return f"it went {depths[worst]:.1f} mm into the {worst}" if worst and depths[worst] > DEEPEST else ""


def set_controls(problem: MuscleProblem, controls: Controls) -> None:
    """Let the problem's energy speak of these controls."""
    problem.controls.ramp.Set(controls.ramp)
    problem.controls.activation.Set(controls.activation)
    problem.controls.turn.set(controls.flexion)


def _failure(
    problem: MuscleProblem, controls: Controls, reason: str, residuals: tuple[float, ...]
) -> NotConvergedError:
    angle = problem.arm.reference_angle + controls.flexion
    history = ", ".join(f"{r:.1e}" for r in residuals)
    message = (
        f"{problem.name} at activation {controls.activation:.3f}, {degrees(angle):.1f} degrees, pre-stretch ramp"
        f" {controls.ramp:.2f}: {reason}; residual over reaction: {history or 'none'}"
    )
    return NotConvergedError(message, SolvePoint(problem.name, controls.activation, angle), residuals)
