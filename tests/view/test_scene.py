"""What the software renderer draws: areas, depth, light, directions; all in closed form."""

import io

import numpy as np
import pytest

from myograph.view.canvas import RESOLUTION, new_figure, png
from myograph.view.scene import CONTOUR, Camera, PaintedSurface, draw_surfaces, side_camera
from myograph.view.surface import capsule

FRONT = Camera(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))
RED, BLUE = np.array([0.9, 0.1, 0.1]), np.array([0.1, 0.1, 0.9])
HALF_WIDTH = 40.0


def ball(centre: tuple[float, float, float], radius: float, colour: np.ndarray) -> PaintedSurface:
    middle = np.array(centre)
    step = np.array([0, 1e-6, 0])
    surface = capsule(middle - step, middle + step, radius, "ball", "#000000")
    return PaintedSurface(surface.points, surface.quads, np.tile(colour, (len(surface.points), 1)))


def picture(*surfaces: PaintedSurface, relief: float = 1.0) -> np.ndarray:
    """Pixels (rows, columns, red green blue) of a square from -40 to 40 mm, seen by the front camera."""
    from matplotlib.image import imread

    figure = new_figure(2.0, 2.0)
    figure.set_layout_engine("none")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-HALF_WIDTH, HALF_WIDTH), ylim=(-HALF_WIDTH, HALF_WIDTH))
    axes.set_axis_off()
    draw_surfaces(axes, FRONT, surfaces, relief)
    return imread(io.BytesIO(png(figure)))[:, :, :3]


def at(pixels: np.ndarray, right: float, up: float) -> np.ndarray:
    scale = 2.0 * RESOLUTION / (2 * HALF_WIDTH)
    return pixels[int((HALF_WIDTH - up) * scale), int((right + HALF_WIDTH) * scale)]


def drawn_area(pixels: np.ndarray) -> float:
    """Area [mm²] of the pixels that are more than half covered on white paper."""
    return float(np.sum(pixels.min(axis=2) < 0.6) * (2 * HALF_WIDTH / (2.0 * RESOLUTION)) ** 2)


def test_a_ball_covers_a_disc():
    """Its radius is that of the ball and the contour; matplotlib may blow facets up by a pixel."""
    radius, pixel = 20 + CONTOUR, 2 * HALF_WIDTH / (2.0 * RESOLUTION)
    assert np.pi * radius**2 < drawn_area(picture(ball((3, -5, 0), 20.0, RED))) < np.pi * (radius + pixel) ** 2


def test_a_coarse_ball_looks_round():
    """An octagon would cover 10 % less than the disc around it."""
    turn, latitude = np.linspace(0, 2 * np.pi, 8, endpoint=False), np.linspace(-1.2, 1.2, 5)
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    points = np.cos(latitude)[:, None, None] * ring + np.sin(latitude)[:, None, None] * np.array([0, 0, 1.0])
    index = np.arange(40).reshape(5, 8)
    following = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], following[:-1], following[1:], index[1:]], axis=-1).reshape(-1, 4)
    surface = PaintedSurface(30 * points.reshape(-1, 3), quads, np.tile(RED, (40, 1)))
    hole = 8 / 2 * np.sin(2 * np.pi / 8) * (30 * np.cos(1.2)) ** 2
    assert drawn_area(picture(surface)) + hole > 0.97 * np.pi * 30**2


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_nearer_body_hides_the_farther(order):
    bodies = [ball((0, 0, 30), 10.0, RED), ball((0, 0, -30), 20.0, BLUE)]
    pixels = picture(*(bodies[k] for k in order))
    assert at(pixels, 0, 0)[0] > at(pixels, 0, 0)[2]
    assert at(pixels, 15, 0)[2] > at(pixels, 15, 0)[0]


def test_without_relief_colours_are_what_they_were():
    pixels = picture(ball((0, 0, 0), 20.0, RED), relief=0.0)
    np.testing.assert_allclose(at(pixels, 5, -7), RED, atol=1 / 255)


def test_light_comes_from_above_left():
    pixels = picture(ball((0, 0, 0), 20.0, RED))
    assert at(pixels, -9, 0).sum() > at(pixels, 9, 0).sum()
    assert at(pixels, 0, 9).sum() > at(pixels, 0, -9).sum()


def test_the_brightest_point_of_a_ball_faces_the_lamp():
    """Beside the gloss, brightness is ambient + diffuse n·l, largest where n = l."""
    from myograph.view.scene import AMBIENT, DIFFUSE, HALFWAY, LAMP, _lit

    normals = np.stack([LAMP, -LAMP])
    grey = np.full((2, 3), 0.5)
    bright, dark = _lit(grey, normals, 1.0)
    gloss = 0.16 * (LAMP @ HALFWAY) ** 24
    np.testing.assert_allclose(bright, 0.5 * (AMBIENT + DIFFUSE) + gloss)
    np.testing.assert_allclose(dark, 0.5 * AMBIENT)


@pytest.mark.parametrize(("turn", "tilt"), [(0.0, 0.0), (0.3, 0.12), (np.pi - 0.3, 0.12), (1.0, -0.5)])
def test_a_camera_is_a_right_handed_frame(turn, tilt):
    camera = side_camera(turn, tilt)
    frame = np.stack([camera.right, camera.up, camera.towards])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1)


def test_from_the_lateral_side_of_a_left_arm_the_hand_points_left_and_the_head_is_up():
    camera = side_camera(turn=0.0, tilt=0.0)
    np.testing.assert_allclose(camera.project(np.array([1.0, 1.5, 0.0]) / np.sqrt(3.25)), [-1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(camera.project(np.array([0.0, 0.0, 1.0])), [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(camera.project(np.array([-1.5, 1.0, 0.0]) / np.sqrt(3.25)), [0, 0, 1], atol=1e-12)


def test_from_the_medial_side_the_hand_points_right():
    assert side_camera(turn=np.pi).project(np.array([1.0, 1.5, 0.0]))[0] > 0
