"""Draw all five muscles at 10, 60 and 150 degrees, relaxed and active, solved by finite elements.

python docs/draw_muscles.py [--preset quick] [--out docs/muscles.png]
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.cli.arm import bone_surfaces
from myograph.files import write_whole
from myograph.mechanics.muscle import FiniteElementMuscle, MuscleState
from myograph.mechanics.walk import Walk
from myograph.mesh.tissue import tendon_share
from myograph.view import Surface
from myograph.view.arm import painted
from myograph.view.canvas import new_figure, png
from myograph.view.palette import INK, MUSCLE_COLOURS, SKY
from myograph.view.scene import draw_surfaces, side_camera
from myograph.view.stage import extent_of, set_stage

ANGLES = (10.0, 60.0, 150.0)
ACTIVATIONS = (0.0, 1.0)


def main() -> None:
    """Solve and draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", default="quick")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "muscles.png")
    options = parser.parse_args()
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        solved = dict(zip(MUSCLES, pool.map(partial(solve, options.preset), MUSCLES), strict=True))
    picture = draw(solved)
    write_whole(options.out, lambda file: file.write(picture))


def solve(preset: str, name: str) -> list[tuple[float, float, Surface]]:
    """(angle [degrees], activation, skin) of one muscle in all its poses."""
    arm = built_in_arm()
    muscle = FiniteElementMuscle(arm, name, preset)
    share = tendon_share(arm, name, muscle.mesh)
    poses = []
    places = [(angle, activation) for angle in ANGLES for activation in ACTIVATIONS]
    for number, state in Walk(muscle).states(np.array([(np.radians(angle), a) for angle, a in places])):
        assert isinstance(state, MuscleState), state.reason
        skin = Surface(state.fields["position"], muscle.mesh.skin, name, MUSCLE_COLOURS[name], share)
        poses.append((*places[number], skin))
    return poses


def draw(solved: dict[str, list[tuple[float, float, Surface]]]) -> bytes:
    """A row a muscle, a column a pose; seen from the outer side, with the bones near it."""
    arm, camera = built_in_arm(), side_camera()
    figure = new_figure(13.0, 12.2, SKY)
    rows = figure.subplots(len(solved), len(ANGLES) * len(ACTIVATIONS))
    for row, (name, poses) in zip(rows, solved.items(), strict=True):
        for axes, (angle, activation, skin) in zip(row, sorted(poses, key=lambda pose: pose[:2]), strict=True):
            bones = bone_surfaces(arm, float(np.radians(angle)) - arm.reference_angle)
            set_stage(axes, extent_of([camera.project(skin.points)]))
            draw_surfaces(axes, camera, [painted(surface) for surface in [*bones, skin]])
            axes.set_title(f"{name}, {angle:g}°, {'active' if activation else 'relaxed'}", color=INK, fontsize=9)
    return png(figure)


if __name__ == "__main__":
    main()
