r"""Forward dynamics of a limb about one hinge.

    I θ'' = M(θ, a) - c θ',   a_i' = (u_i - a_i) / τ,   τ = τ_act where u_i > a_i, else τ_deact

I holds the forearm with hand and the weight in the hand as a mass at the hand [N mm s², which is 1e-3 kg mm²]; u is the
excitation of the file. At the start the limb is at rest. Beyond the range of the tables the muscles are not known: a
limb that leaves it is an error; the stops, which are part of M, should turn it before.
Source: first-order activation as in Millard et al. 2013; Runge–Kutta 5(4) of scipy with dense output.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.integrate import solve_ivp

from myograph.anatomy.model import Dynamics, Load
from myograph.errors import InputError, NotConvergedError
from myograph.limb.limb import Limb
from myograph.limb.motion.activation_file import Activations
from myograph.limb.motion.movement import Course, Movement, movement_of
from myograph.units import NEWTON_MM_PER_NEWTON_METRE, STANDARD_GRAVITY, degrees

TONNES_PER_KILOGRAM = 1e-3
"""N = kg m/s² = t mm/s²: the mass that belongs to mm, N and s."""
TOLERANCE = 1e-8
"""Relative error of a step; absolute ones are this times 1 rad, 1 rad/s, 1."""


@dataclass(frozen=True)
class Mechanism:
    """What a limb needs to move.

    Parameters
    ----------
    inertia
        About the hinge [N mm s²].
    damping
        Moment per rate of the angle [N mm s].
    activation_time, deactivation_time
        Time constants [s].
    """

    inertia: float
    damping: float
    activation_time: float
    deactivation_time: float

    def __post_init__(self) -> None:
        if not (self.inertia > 0 and self.damping >= 0 and self.activation_time > 0 and self.deactivation_time > 0):
            raise InputError(f"expected a positive inertia and times, and a damping of at least 0, got {self}")


def mechanism(dynamics: Dynamics, load: Load, hand_load: float) -> Mechanism:
    """The forearm, and the weight in the hand [N] as a mass at the hand; a load below zero pulls without a mass."""
    forearm = load.forearm_mass * (load.centre_of_mass**2 + dynamics.radius_of_gyration**2)
    in_hand = max(hand_load, 0.0) / STANDARD_GRAVITY * load.hand**2
    return Mechanism(
        TONNES_PER_KILOGRAM * (forearm + in_hand),
        dynamics.damping_nms * NEWTON_MM_PER_NEWTON_METRE,
        dynamics.activation_time,
        dynamics.deactivation_time,
    )


@dataclass(frozen=True)
class Start:
    """State at the first time: angle [rad], its rate [rad/s], activations."""

    angle: float
    velocity: float
    activations: tuple[float, ...]


def rest_at(limb: Limb, activations: Activations, hand_load: float, near: float) -> Start:
    """At rest under the first row's activations; raises InputError where there is no rest."""
    first = tuple(activations.values[0].tolist())
    return Start(limb.rest(first, hand_load, near).angle, 0.0, first)


def move(limb: Limb, excitations: Activations, hand_load: float, mechanism: Mechanism, start: Start) -> Movement:
    """The movement at the times of the file.

    Raises NotConvergedError, with time and angle, where the limb leaves its range or the steps get too small.
    """
    limb.check(start.activations, hand_load)
    muscles = list(limb.muscles.values())

    def rate(time: float, state: Float[np.ndarray, " state"]) -> Float[np.ndarray, " state"]:
        angle = np.clip(state[:1], limb.low, limb.high)
        activations = np.clip(state[2:], 0.0, 1.0)
        moment = float(limb.outside(angle, hand_load)[0])
        moment += sum(float(m.moment(angle, float(a))[0]) for m, a in zip(muscles, activations, strict=True))
        lag = excitations.at(time) - state[2:]
        times = np.where(lag > 0, mechanism.activation_time, mechanism.deactivation_time)
        return np.concatenate([[state[1], (moment - mechanism.damping * state[1]) / mechanism.inertia], lag / times])

    times = excitations.times
    found = solve_ivp(
        rate,
        (times[0], times[-1]),
        np.array([start.angle, start.velocity, *start.activations]),
        method="RK45",
        t_eval=times,
        dense_output=True,
        events=_Leaving(limb),
        max_step=min(float(np.median(np.diff(times))), 0.02),
        rtol=TOLERANCE,
        atol=TOLERANCE,
    )
    if found.status == 1:
        time, angle = (
            float(found.t[-1] if not found.t_events[0].size else found.t_events[0][0]),
            found.y_events[0][0][0],
        )
        raise NotConvergedError(
            f"the limb leaves its range at {time:.3f} s: {degrees(angle):.1f} degrees, turning at"
            f" {degrees(found.y_events[0][0][1]):.0f} degrees/s; expected {degrees(limb.low):g} to"
            f" {degrees(limb.high):g} degrees; excite less, or give the arm stiffer stops"
        )
    if found.status != 0:
        raise NotConvergedError(f"the movement stops at {found.t[-1]:.3f} s: {found.message}")
    values = np.clip(found.y[2:].T, 0.0, 1.0)
    course = Course(times, found.y[0], found.y[1], excitations.values, values)
    return movement_of(limb, hand_load, "dynamic", course, excitations.notes)


class _Leaving:
    """Room [rad] between the limb and the ends of its range; the integration ends where it is used up."""

    terminal = True
    direction = -1.0

    def __init__(self, limb: Limb) -> None:
        self.low, self.high = limb.low, limb.high

    def __call__(self, time: float, state: Float[np.ndarray, " state"]) -> float:
        return float(min(state[0] - self.low, self.high - state[0]))
