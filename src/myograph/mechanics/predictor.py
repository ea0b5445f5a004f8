r"""Where a muscle will be after the elbow has turned a little: the guess that Newton's method starts from.

The rate v of the unknowns over the flexion follows from the tangent K at a solved state,

    K v = -∂r/∂θ,    v = boundary's rate on the insertion,

with the change of the residual r by everything that turns: the insertion, the forearm's bones, the bands. Two rates
make a parabola (Adams and Bashforth's second-order formula for uneven steps):

    u(θ + h) = u + h ((1 + h / 2g) v - h / 2g v_before),    g the step before.

Trap: a guess that only moves the insertion leaves the muscle where the forearm's bones have turned to, deep inside
them, and inverts elements.
"""

import numpy as np
from jaxtyping import Float

from myograph.mechanics.problem import MuscleProblem

Unknowns = Float[np.ndarray, " unknowns"]
_SMALL_TURN = 1e-5


def flexion_rate(problem: MuscleProblem, vector: Unknowns, flexion: float) -> Unknowns:
    """Derivative of a solved state's unknowns over the flexion [per rad], at the problem's present controls."""
    turn, step = problem.controls.turn, _SMALL_TURN
    boundary = (problem.boundary_values(flexion + step) - problem.boundary_values(flexion - step)) / (2 * step)
    tangent = problem.tangent(vector)
    turn.set(flexion + step)
    after = problem.residual(vector)
    turn.set(flexion - step)
    before = problem.residual(vector)
    turn.set(flexion)
    return boundary - tangent.solve((after - before) / (2 * step) + tangent.times(boundary))


def extrapolated(rate: Unknowns, rate_before: Unknowns | None, step: float, step_before: float) -> Unknowns:
    """Change of the unknowns over a turn by `step` [rad]; a straight line where the turn before went the other way."""
    if rate_before is None or step * step_before <= 0:
        return step * rate
    share = step / (2 * step_before)
    return step * ((1 + share) * rate - share * rate_before)
