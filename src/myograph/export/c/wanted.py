"""How many modes a muscle in C has: the fewest within a tolerance, or the most that a size allows.

The error is the largest distance from the full model over the corners of the trained range and many activations
between, at all nodes that are written; for von Mises stress it is the largest difference.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.export.c.layers import FLOAT_BYTES, MOST_ROWS, Layers, in_float, in_int8, roundings
from myograph.export.c.reduced import amounts_over, on_surface, with_modes
from myograph.fields import von_mises
from myograph.inference.low_rank import LowRankField, LowRankMuscle

STRESS_SHARE = 0.01
"""Error of von Mises stress over the largest value of the field, at most."""
ROUNDED = 1e-5
"""Error of rounding over the largest value of the field that nobody needs to go below."""
KILOBYTE = 1000
_STRESS = ("von_mises", "cauchy_stress")


@dataclass(frozen=True)
class Wanted:
    """What is asked for.

    Parameters
    ----------
    kind
        Of the modes' numbers.
    tolerance_mm
        Largest distance from the full model; None takes all modes that the size allows.
    most_kb
        Largest size of the constant arrays [1000 bytes]; None for no limit.
    surface
        Only the nodes of the surface.
    stress
        Von Mises stress, too.
    """

    kind: Literal["float", "int8"] = "float"
    tolerance_mm: float | None = 0.25
    most_kb: float | None = None
    surface: bool = True
    stress: bool = False


@dataclass(frozen=True)
class Reduced:
    """A muscle to be written.

    Parameters
    ----------
    muscle
        The full model, at the nodes that are written.
    kind
        Of the modes' numbers.
    layers
        'position', and if wanted 'von_mises' or 'cauchy_stress'.
    errors
        Largest differences from the full model: position [mm], von_mises [MPa].
    modes
        Of each field.
    """

    muscle: LowRankMuscle
    kind: Literal["float", "int8"]
    layers: dict[str, Layers]
    errors: dict[str, float]
    modes: dict[str, int]

    @property
    def bytes(self) -> int:
        """Of all constant arrays that predictions read."""
        angle = self.muscle.angle
        arrays = (angle.centre, angle.scale, angle.first, angle.first_offset, angle.second, angle.second_offset)
        network = sum(array.size for array in (*arrays, angle.last, angle.last_offset))
        return FLOAT_BYTES * network + sum(layers.bytes for layers in self.layers.values())


def reduced_muscle(muscle: LowRankMuscle, wanted: Wanted) -> Reduced:
    """The muscle with as few modes as the tolerance allows, or as many as the size does.

    Raises InputError for a tolerance or a size that cannot be met, saying what can, for stress that the model does not
    have, and for the surface of a model without one.
    """
    _check(muscle, wanted)
    chosen = on_surface(muscle) if wanted.surface else muscle
    found = Reduced(chosen, wanted.kind, {}, {}, {})
    if wanted.stress:
        found = _with_stress(found)
    limit = None if wanted.most_kb is None else wanted.most_kb * KILOBYTE
    best = None
    for candidate in _candidates(found, "position", wanted.tolerance_mm or 0.0):
        if limit is not None and candidate.bytes > limit:
            break
        best = candidate
        if wanted.tolerance_mm is not None and candidate.errors["position"] <= wanted.tolerance_mm:
            return candidate
    if best is None or wanted.tolerance_mm is not None:
        raise InputError(_refusal(found, best, wanted))
    return best


def _refusal(found: Reduced, best: Reduced | None, wanted: Wanted) -> str:
    if best is None:
        least = next(_candidates(found, "position", 0.0)).bytes / KILOBYTE
        return f"{found.muscle.name}: expected room for one mode at least, {least:.1f} kB, got {wanted.most_kb:g} kB"
    room = "" if wanted.most_kb is None else f" and at most {wanted.most_kb:g} kB"
    got = f"{best.errors['position']:.3g} mm with {best.modes['position']} modes and {best.bytes / KILOBYTE:.1f} kB"
    return (
        f"{found.muscle.name}: expected modes within {wanted.tolerance_mm:g} mm{room}, got {got}; allow more of either"
    )


def _check(muscle: LowRankMuscle, wanted: Wanted) -> None:
    for name, value in (("tolerance", wanted.tolerance_mm), ("size", wanted.most_kb)):
        if value is not None and not (np.isfinite(value) and value > 0):
            raise InputError(f"{name}: expected a number above 0, got {value:g}")
    if wanted.stress and not set(_STRESS) & set(muscle.fields):
        raise InputError(f"{muscle.name}: expected a model with stress, got one of {', '.join(muscle.fields)}")


def _with_stress(found: Reduced) -> Reduced:
    """With the fewest modes of stress that are exact enough, else with all."""
    name = next(name for name in _STRESS if name in found.muscle.fields)
    field = found.muscle.fields[name]
    values = _values(field, amounts_over(found.muscle, name))
    most = float(np.abs(values if name == "von_mises" else von_mises(values)).max())
    last = found
    for candidate in _candidates(found, name, STRESS_SHARE * most):
        last = candidate
        if candidate.errors["von_mises"] <= STRESS_SHARE * most:
            break
    return last


def _candidates(found: Reduced, name: str, tolerance: float) -> Iterator[Reduced]:
    """One more mode each time."""
    field, amounts = found.muscle.fields[name], amounts_over(found.muscle, name)
    full = _values(field, amounts)
    shown = "position" if name == "position" else "von_mises"
    for count in range(1, len(field.modes) + 1):
        cut, first = with_modes(field, count), amounts[:, :count]
        left_out = _error(name, _values(cut, first), full)
        finest = max(tolerance, left_out, ROUNDED * float(np.abs(full).max()))
        layers = in_float(cut) if found.kind == "float" else in_int8(cut, _rows_of(cut, first, finest / 4))
        errors = {**found.errors, shown: _error(name, layers.values(first), full)}
        yield replace(found, layers={**found.layers, name: layers}, errors=errors, modes={**found.modes, shown: count})


def _rows_of(field: LowRankField, amounts: np.ndarray, budget: float) -> list[int]:
    """Rows of each mode: one, and more for those whose rounding is felt beyond the budget of all together."""
    rows_of = [1] * len(field.modes)
    while True:
        felt = roundings(field, rows_of, amounts)
        felt[np.array(rows_of) == MOST_ROWS] = 0.0
        if np.sqrt(np.square(felt).sum()) <= budget:
            return rows_of
        rows_of[int(felt.argmax())] += 1


def _values(field: LowRankField, amounts: np.ndarray) -> Float[np.ndarray, "asked nodes components"]:
    return field.mean + np.tensordot(amounts, field.modes, axes=1)


def _error(name: str, values: np.ndarray, full: np.ndarray) -> float:
    if name == "cauchy_stress":
        return float(np.abs(von_mises(values) - von_mises(full)).max())
    return float(np.linalg.norm(values - full, axis=-1).max())
