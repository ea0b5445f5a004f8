"""Pictures of the arm, of one muscle, of movements, and of curves, as PNG bytes.

Matplotlib's software renderer draws everything: the same picture on every machine, without a display or a graphics
driver. Nothing touches matplotlib's global state.
"""

from myograph.view.arm import draw_arm
from myograph.view.bars import draw_error_bars
from myograph.view.curves import Line, draw_lines, draw_moments, draw_training
from myograph.view.equilibria import draw_equilibria
from myograph.view.film import draw_film
from myograph.view.heat import draw_heat_maps
from myograph.view.movement import draw_movement
from myograph.view.network import NetworkNodes, draw_network_nodes
from myograph.view.scene import Camera, side_camera
from myograph.view.states import draw_states
from myograph.view.surface import Surface, capsule

__all__ = [
    "Camera",
    "Line",
    "NetworkNodes",
    "Surface",
    "capsule",
    "draw_arm",
    "draw_equilibria",
    "draw_error_bars",
    "draw_film",
    "draw_heat_maps",
    "draw_lines",
    "draw_moments",
    "draw_movement",
    "draw_network_nodes",
    "draw_states",
    "draw_training",
    "side_camera",
]
