"""Forces over elbow angles for three activations: ours as lines, the published samples as points."""

import io

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from myograph.anatomy.body import line_of_action
from myograph.anatomy.model import Arm
from myograph.limb.tables.table import MuscleTable

SHOWN = (0.146447, 0.5, 0.853553)
COLOURS = ("#3b6ea5", "#7a5195", "#c0392b")


def draw(arm: Arm, tables: dict[str, MuscleTable], samples: np.ndarray, columns: dict[str, int]) -> bytes:
    """PNG with one panel a muscle; hollow points were not seen by the fit."""
    figure, panels = plt.subplots(1, len(tables), figsize=(10, 4.2), layout="constrained")
    seen = np.arange(len(samples)) % 2 == 0
    for panel, (name, table) in zip(panels, tables.items(), strict=True):
        line = line_of_action(arm.muscles[name], arm.hinge.frame())
        degrees = np.linspace(10, 150, 141)
        arms = np.array([line.moment_arm(np.radians(angle) - arm.reference_angle) for angle in degrees])
        for activation, colour in zip(SHOWN, COLOURS, strict=True):
            panel.plot(
                degrees, table.moment(np.radians(degrees), activation) / arms, color=colour, label=f"{activation:.2f}"
            )
            for part, face in ((seen, colour), (~seen, "white")):
                here = part & (np.abs(samples[:, 1] - activation) < 1e-3)
                forces = np.abs(samples[here, columns[name]])
                panel.plot(samples[here, 0], forces, "o", color=colour, markerfacecolor=face, markersize=5)
        panel.set(title=name, xlabel="elbow angle [degrees]", ylabel="force [N]", xlim=(5, 155), ylim=(0, None))
        panel.grid(alpha=0.25)
    panels[0].legend(title="activation", loc="upper left")
    figure.suptitle("lines: this arm; points: Valentin 2019, hollow where the fit did not see them", fontsize=10)
    with io.BytesIO() as file:
        figure.savefig(file, dpi=110)
        plt.close(figure)
        return file.getvalue()
