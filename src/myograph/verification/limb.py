r"""The published limb of two muscles: angles at rest, least activations, and a load that nothing holds.

    F_T l_T + F_B l_B + F_load l_load = 0  (extension positive)
    l_T = 22.21 + 0.1126 θ - 0.0009399 θ²,  l_B = 35.02 + 0.1776 θ - 0.001482 θ²,
    l_load = 282.5 sin θ  [mm, θ in degrees, 10 to 150];  forces from 49 finite-element samples each

The samples are not part of the package: the checks are there where their folder is named. The tolerances of the angles
are half a degree; the published largest error of these angles is 0.886 degrees, that of the activations 0.01.
Source: Valentin, Sprenger, Pflüger, Röhrle 2018; samples in Valentin 2019.
"""

from collections.abc import Callable
from functools import cache
from pathlib import Path

from myograph.limb.force_limb import ForceLimb, HandWeight, MuscleColumn, limb_from_forces
from myograph.limb.limb import Limb
from myograph.limb.optimise import Target, optimise
from myograph.units import degrees, radians
from myograph.verification.check import Check

SAMPLES = Path("stuttgart") / "sparse_grid_clenshaw_curtis.csv"
"""Inside the folder of reference data."""
FAMILY = "limb"
HOW = (
    "the published limb needs samples that are not part of myograph: name the folder that holds"
    f" {SAMPLES} with --data or MYOGRAPH_REFERENCE_DATA"
)
_COLUMNS = {"samples": SAMPLES, "angle_deg": "theta_deg", "activation": "alpha"}
TWO_MUSCLES = ForceLimb(
    name="two-muscle limb",
    range_deg=(10.0, 150.0),
    load=HandWeight(hand=282.5),
    muscles={
        "triceps": MuscleColumn(**_COLUMNS, column="F_T_N", acts="extends", lever_mm=(22.21, 0.1126, -0.0009399)),
        "biceps": MuscleColumn(
            **_COLUMNS, column="F_B_N", scale=-1.0, acts="flexes", lever_mm=(35.02, 0.1776, -0.001482)
        ),
    },
)
HALF_A_DEGREE = 0.5
_ANGLES = {
    "rest": (0.0, 0.0, 22.0, 48.5),
    "biceps": (0.0, 1.0, 22.0, 83.9),
    "half": (0.5, 0.5, 22.0, 49.5),
    "triceps": (1.0, 0.0, 22.0, 21.9),
    "both": (1.0, 1.0, 22.0, 52.7),
    "rest_unloaded": (0.0, 0.0, 0.0, 63.9),
    "both_unloaded": (1.0, 1.0, 0.0, 64.2),
}
"""Name -> activations of triceps and biceps, load [N], published angle [degrees]."""


def checks(folder: Path | None, spec: ForceLimb = TWO_MUSCLES) -> tuple[Check, ...]:
    """The checks that the folder of reference data allows: all of them, or none."""
    if folder is None or not (folder / SAMPLES).exists():
        return ()
    limb = cache(lambda: limb_from_forces(spec, folder, gravity=False))
    source = "Valentin et al. 2018"
    angles = [
        Check(f"{FAMILY}.{name}", "elbow angle at rest [°]", _angle(limb, (t, b), load), known, source,
              round(HALF_A_DEGREE / known, 3))
        for name, (t, b, load, known) in _ANGLES.items()
    ]  # fmt: skip
    return (
        *angles,
        Check(f"{FAMILY}.least", "least activation of the biceps, 75° with 22 N", _least(limb), 0.667, source, 0.015),
        Check(f"{FAMILY}.none", "angles at rest with -60 N", lambda: _count(limb(), -60.0), 0.0, source, 1e-9),
    )


def _angle(limb: Callable[[], Limb], activations: tuple[float, float], load: float) -> Callable[[], float]:
    return lambda: degrees(limb().rest(activations, load, radians(60.0)).angle)


def _least(limb: Callable[[], Limb]) -> Callable[[], float]:
    return lambda: optimise(limb(), Target(radians(75.0), 22.0)).activations[1]


def _count(limb: Limb, load: float) -> float:
    """Number of equilibria with the triceps at rest, over all activations of the biceps."""
    return float(sum(len(limb.equilibria((0.0, tenth / 10), load)) for tenth in range(11)))
