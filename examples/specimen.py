"""A cube of muscle, its law chosen by name: stress along the fibres over their stretch, relaxed to fully active."""

from myograph.materials.catalogue import LAWS
from myograph.mechanics.specimen import Box, Load, Specimen, solve

PARAMETERS = {
    "G1": 5e-4,
    "G2": 5e-4,
    "P1": 0.05,
    "P2": 6.6,
    "L_ofl": 1.07,
    "l_star": 1.4,
    "sigma_max": 0.3,
    "K": 50.0,
}
STRETCHES = (0.9, 1.0, 1.1, 1.2, 1.3)


def stresses(activation: float) -> list[float]:
    """Cauchy stress [MPa] along the fibres at each stretch; the sides are free, three faces are planes of symmetry."""
    cube = Specimen(Box(size=(1.0, 1.0, 1.0)), LAWS["blemker"](**PARAMETERS), fibre=(1.0, 0.0, 0.0))
    states = [
        solve(cube, Load(displacement={"x_max": (stretch - 1, None, None)}, activation=activation))
        for stretch in STRETCHES
    ]
    return [float(state.mean_stress[0, 0]) for state in states]


if __name__ == "__main__":
    print(f"{'stretch':14}" + "".join(f"{stretch:8.2f}" for stretch in STRETCHES))
    for activation in (0.0, 0.5, 1.0):
        row = "".join(f"{round(stress, 3) + 0:8.3f}" for stress in stresses(activation))
        print(f"activation {activation:3.1f}{row} MPa")
