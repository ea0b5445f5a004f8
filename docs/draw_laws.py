"""Draw every material law: `python docs/draw_laws.py` renews the pictures beside the pages in docs/laws.

Left, the stress of the fibres dψ/dl (nominal) at rest, by activation, and both together. Right, a bar along the fibre
with free sides: force over its reference section, at three activations. NumPy only, no finite elements.
"""

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.anatomy.load import built_in_arm
from myograph.materials.functions import NUMPY
from myograph.materials.invariants import Invariants, invariants
from myograph.materials.law import Law
from myograph.materials.literature import LITERATURE
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.materials.neo_hooke import NeoHooke
from myograph.view.canvas import legend_below, new_figure, tidy
from myograph.view.palette import FAINT, INK, SERIES_COLOURS

PAGES = Path(__file__).parent / "laws"
RESOLUTION = 95
"""Pixels per inch: pictures stay small enough to keep beside the pages."""
STEP = 1e-5


@dataclass(frozen=True)
class Sheet:
    """A law with the stretches to draw, and the factor and unit of stress to draw it in."""

    law: Law
    shortest: float
    longest: float
    factor: float = 1e3
    unit: str = "kPa"


def sheets() -> dict[str, Sheet]:
    """Name of a law -> what its picture shows."""
    biceps = built_in_arm().muscles["biceps"]
    return {
        "gauss": Sheet(biceps.belly, 0.7, 1.9),
        "toe_tendon": Sheet(biceps.tendon, 0.98, 1.06, 1.0, "MPa"),
        "roehrle": Sheet(LITERATURE["roehrle muscle"], 0.7, 1.48),
        "heidlauf_roehrle": Sheet(LITERATURE["heidlauf_roehrle muscle"], 0.6, 1.8),
        "blemker": Sheet(LITERATURE["blemker muscle"], 0.4, 1.8),
        "blemker_tendon": Sheet(LITERATURE["blemker_tendon tendon"], 0.98, 1.06, 1.0, "MPa"),
        "trans_iso_mooney_rivlin": Sheet(LITERATURE["trans_iso_mooney_rivlin tendon"], 0.98, 1.06, 1.0, "MPa"),
        "guccione": Sheet(LITERATURE["guccione active heart"], 0.7, 1.3),
        "neo_hooke": Sheet(NeoHooke(E=1.0, nu=0.3, contraction="fibre", active_stress=0.5), 0.6, 1.4, 1.0, "MPa"),
        "mooney_rivlin": Sheet(
            MooneyRivlin(c1=1.0, c2=0.5, K=1000.0, contraction="fibre", active_stress=0.5), 0.6, 1.4, 1.0, "MPa"
        ),
    }


def draw(sheet: Sheet) -> bytes:
    """The picture of one law as PNG."""
    from matplotlib.lines import Line2D

    stretch = np.linspace(sheet.shortest, sheet.longest, 241)
    figure = new_figure(8.4, 3.6)
    left, right = figure.subplots(1, 2)
    tidy(left, "stretch of the fibre [-]", f"nominal stress [{sheet.unit}]")
    tidy(right, "stretch of a bar along the fibre [-]", f"nominal stress [{sheet.unit}]")
    passive, active = (fibre_stress(sheet.law, part, stretch) for part in ("passive_fibre", "active"))
    handles = []
    names, styles = ("fibre at rest", "fibre, by activation", "fibre, both"), ("-", "--", ":")
    for k, stress in enumerate((passive, active, passive + active)):
        if np.abs((passive, active, passive * active)[k]).max() > 0:
            left.plot(stretch, sheet.factor * stress, styles[k], color=SERIES_COLOURS[k], linewidth=1.8)
            handles.append(Line2D([], [], color=SERIES_COLOURS[k], linestyle=styles[k], label=names[k]))
    for k, level in enumerate((0.0, 0.5, 1.0) if np.abs(active).max() > 0 else (0.0,)):
        force = bar_stress(sheet.law, stretch, level)
        right.plot(stretch, sheet.factor * force, color=SERIES_COLOURS[3 + k], linewidth=1.8)
        handles.append(Line2D([], [], color=SERIES_COLOURS[3 + k], label=f"bar, activation {level:g}"))
    for axes in (left, right):
        axes.axhline(0.0, color=INK, linewidth=0.8, zorder=0)
        axes.axvline(1.0, color=FAINT, linewidth=0.8, zorder=0)
    legend_below(figure, handles)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=RESOLUTION, metadata={"Software": None})
    return buffer.getvalue()


def fibre_stress(law: Law, part: str, stretch: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
    """dψ/dl of the law's `passive_fibre` or `active`, with the volume kept [MPa]."""
    high, low = (getattr(law, part)(_bar(stretch + s, (stretch + s) ** -0.5), NUMPY) for s in (STEP, -STEP))
    return np.broadcast_to((high - low) / (2 * STEP), stretch.shape)


def bar_stress(law: Law, stretch: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
    """Force over reference section of a bar whose sides are free [MPa]: dW/dl at the width where dW/dwidth = 0."""

    def energy(along: np.ndarray, across: np.ndarray) -> np.ndarray:
        return np.asarray(law.energy(_bar(along, across), activation, NUMPY))

    low, high = 0.5 * stretch**-0.5, 1.5 * stretch**-0.5
    for _ in range(50):
        width = 0.5 * (low + high)
        too_wide = energy(stretch, width + STEP) > energy(stretch, width - STEP)
        low, high = np.where(too_wide, low, width), np.where(too_wide, width, high)
    return (energy(stretch + STEP, low) - energy(stretch - STEP, low)) / (2 * STEP)


def _bar(along: np.ndarray, across: np.ndarray) -> Invariants:
    F = np.zeros((*along.shape, 3, 3))
    F[..., 0, 0], F[..., 1, 1], F[..., 2, 2] = along, across, across
    return invariants(F, np.broadcast_to([1.0, 0.0, 0.0], (*along.shape, 3)).copy())


def main() -> None:
    """Draw all."""
    for name, sheet in sheets().items():
        (PAGES / f"{name}.png").write_bytes(draw(sheet))


if __name__ == "__main__":
    main()
