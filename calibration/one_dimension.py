"""The muscle as a spring on its line of action: belly and tendons in series, no bulk, no contact.

The belly's length changes with the line's, less what the tendons give; its force is the law's nominal stress times the
physiological cross-section. Good to a few per cent of the solid muscle, in a thousandth of its time.
"""

import numpy as np
from scipy.optimize import least_squares

from myograph.anatomy.body import line_of_action, muscle_body
from myograph.anatomy.model import Arm
from myograph.materials.functions import NUMPY
from myograph.materials.invariants import Invariants
from parameters import with_values

_SMALL = 1e-5
_STIFFNESS_KEPT = 0.1
"""Share of the peak stress by which a fully active belly must stiffen per unit of stretch, everywhere in its range."""


def fit_line(arm: Arm, name: str, samples: np.ndarray, published: np.ndarray, values: dict[str, float]) -> np.ndarray:
    """Parameters (in the order of `values`) whose forces on the line of action are nearest to the published ones."""
    keys = tuple(values)
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    excursion = np.array(
        [line.length(np.radians(angle) - arm.reference_angle) for angle in samples[:, 0]]
    ) - line.length(0.0)

    def residual(x: np.ndarray) -> np.ndarray:
        other = with_values(arm, name, dict(zip(keys, np.exp(x), strict=True)))
        force, stretch = line_forces(other, name, excursion, samples[:, 1])
        return np.append((force - published) / np.linalg.norm(published), _softening(other, name, stretch))

    start = np.log(list(values.values()))
    low = np.where(np.array(keys) == "belly.passive_exponent", 0.0, start - 0.5)
    return np.exp(least_squares(residual, start, bounds=(low, start + 0.5)).x)


def line_forces(arm: Arm, name: str, excursion: np.ndarray, activation: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Forces [N] and fibre stretches where belly and tendons carry the same, by bisection over the tendons' strain."""
    muscle = arm.muscles[name]
    free = muscle.tendons.origin + muscle.tendons.insertion
    belly = muscle_body(arm, name, 41).length - free
    low, high = np.zeros_like(excursion), np.full_like(excursion, 0.2)
    for _ in range(40):
        strain = 0.5 * (low + high)
        stretch = muscle.tissue.prestretch * (belly + excursion - free * strain) / belly
        pulls = muscle.tissue.tendon_area * _stress(muscle.tendon, 1 + strain, 0.0)
        more = pulls < muscle.tissue.pcsa * _stress(muscle.belly, stretch, activation)
        low, high = np.where(more, strain, low), np.where(more, high, strain)
    return muscle.tissue.pcsa * _stress(muscle.belly, stretch, activation), stretch


def _stress(law, stretch: np.ndarray, activation: np.ndarray | float) -> np.ndarray:
    """Nominal fibre stress [MPa]: the derivative of the fibre's energy over its stretch."""
    ends = [_fibre_energy(law, stretch + step, activation) for step in (-_SMALL, _SMALL)]
    return (ends[1] - ends[0]) / (2 * _SMALL)


def _fibre_energy(law, stretch: np.ndarray, activation: np.ndarray | float) -> np.ndarray:
    square = np.asarray(stretch, dtype=float) ** 2
    at = Invariants(I1=square, I2=square, I4=square, I5=square**2, J=np.ones_like(square))
    return law.passive_fibre(at, NUMPY) + activation * law.active(at, NUMPY)


def _softening(arm: Arm, name: str, stretch: np.ndarray) -> np.ndarray:
    """How far the active belly falls short of stiffening, over its range of stretches: Newton's method needs it."""
    belly = arm.muscles[name].belly
    places = np.linspace(stretch.min(), stretch.max() + 0.02, 40)
    slope = np.gradient(_stress(belly, places, 1.0), places)
    return np.minimum(slope / belly.peak_stress - _STIFFNESS_KEPT, 0.0)
