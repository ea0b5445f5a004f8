"""Pictures decode, have their size, show something, repeat exactly, and leave matplotlib's global state alone."""

import io
import itertools
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import label

from myograph.case import MUSCLES
from myograph.errors import InputError, MissingPackageError
from myograph.evaluation import ErrorSummary
from myograph.view import (
    Line,
    NetworkNodes,
    Surface,
    capsule,
    draw_arm,
    draw_error_bars,
    draw_heat_maps,
    draw_lines,
    draw_moments,
    draw_network_nodes,
    draw_states,
    draw_training,
)
from myograph.view.canvas import RESOLUTION
from myograph.view.palette import BONE, MUSCLE_COLOURS, SERIES_COLOURS

STEPS = np.arange(0, 1000, 50)
SENSORS = 131 * np.arange(9) + 5


def pixels(png: bytes) -> np.ndarray:
    from matplotlib.image import imread

    return imread(io.BytesIO(png), format="png")[:, :, :3]


def rgb(colour: str) -> np.ndarray:
    return np.array([int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)])


def arm(biceps) -> list[Surface]:
    points, quads = biceps["position"].values[0], biceps["surface_quads"].values
    tendon = np.clip(np.abs(points[:, 2] + 460) / 40 - 2, 0, 1)
    elbow = np.array([35.4, 114.6, -585.6])
    humerus = capsule(elbow, np.array([102.8, 174.1, -301.3]), 11.0, "bone", BONE)
    forearm = capsule(elbow, np.array([109.1, 277.1, -781.3]), 8.0, "bone", BONE)
    return [Surface(points, quads, "biceps", MUSCLE_COLOURS["biceps"], tendon), humerus, forearm]


def network(count: int) -> NetworkNodes:
    positions = np.random.default_rng(0).uniform([0, 100, -650], [130, 200, -300], (count, 3))
    return NetworkNodes(f"{count} nodes", positions, np.array(list(itertools.combinations(range(count), 2))))


def summaries() -> dict[str, dict[str, ErrorSummary]]:
    return {
        m: {p: ErrorSummary(k, k, 2.0 * k, 5.0 * k, 0.1) for p in ("thesis", "strict")}
        for m, k in (("a", 1.0), ("b", 2.0))
    }


def draw(name: str, biceps) -> bytes:
    position, quads = biceps["position"].values, biceps["surface_quads"].values
    errors = np.linalg.norm(position[31] - position[0], axis=1)
    angle = np.linspace(10, 150, 15)
    moments = {muscle: {a: a * np.sin(np.radians(angle)) for a in (0.0, 1.0)} for muscle in MUSCLES}
    drawers = {
        "arm": lambda: draw_arm(arm(biceps), "60°"),
        "states": lambda: draw_states(position[0], position[31], quads, SENSORS),
        "heat": lambda: draw_heat_maps(position[0], quads, {"affine": errors, "gen_8": errors / 3}),
        "network": lambda: draw_network_nodes([network(8)], [network(30)], position[0]),
        "training": lambda: draw_training({"gen_8": (STEPS, 20 * np.exp(-STEPS / 300) + 1)}),
        "moments": lambda: draw_moments(angle, moments),
        "bars": lambda: draw_error_bars(summaries()),
        "lines": lambda: draw_lines([Line("table", angle, angle)], "activation", "angle [°]"),
    }
    return drawers[name]()


NAMES = ("arm", "states", "heat", "network", "training", "moments", "bars", "lines")


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_decodes_and_shows_something(name, biceps):
    picture = pixels(draw(name, biceps))
    rows, columns = picture.shape[:2]
    assert min(rows, columns) > 2 * RESOLUTION
    assert max(rows, columns) < 13 * RESOLUTION
    assert 0.02 < np.mean(np.abs(picture - picture[0, 0]).max(axis=2) > 0.1) < 0.9


@pytest.mark.parametrize("name", ["training", "moments", "bars", "lines"])
def test_a_plot_has_its_size(name, biceps):
    assert pixels(draw(name, biceps)).shape[:2] == (round(4.4 * RESOLUTION), round(7.6 * RESOLUTION))


def test_the_same_picture_twice_is_the_same_file(biceps):
    assert draw("states", biceps) == draw("states", biceps)


def test_a_muscle_is_drawn_in_its_hue_and_its_tendon_white(biceps):
    muscle = arm(biceps)[0]
    picture, belly_only = (pixels(draw_arm([drawn])) for drawn in (muscle, replace(muscle, tendon=None)))
    orange = (belly_only[..., 0] > 0.5) & (belly_only[..., 2] < 0.5 * belly_only[..., 0])
    rows, columns = np.nonzero(orange)
    white = (picture.min(axis=2) > 0.6)[rows, columns].mean()
    still_orange = (picture[..., 2] < 0.5 * picture[..., 0])[rows, columns].mean()
    assert orange.mean() > 0.02
    assert 0.05 < white < 0.5
    assert 0.3 < still_orange < 0.9


def test_muscles_are_told_apart_by_colour_blind_readers():
    """CIE76 distance of any two, also without one kind of cones (Machado et al. 2009); 2.3 is just noticeable."""
    without = {
        "none": np.eye(3),
        "red": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        "green": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        "blue": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    }
    for cones in without.values():
        lab = [cielab(np.array(cones) @ linear(rgb(colour))) for colour in MUSCLE_COLOURS.values()]
        assert min(np.linalg.norm(a - b) for a, b in itertools.combinations(lab, 2)) > 15


def linear(colour: np.ndarray) -> np.ndarray:
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


def cielab(colour: np.ndarray) -> np.ndarray:
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(to_xyz @ np.clip(colour, 0, 1) / [0.9505, 1.0, 1.089])
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def test_both_states_show_each_sensor_as_a_black_dot_and_queries_blue(biceps):
    picture = pixels(draw("states", biceps))
    sizes = np.bincount(label(picture.max(axis=2) < 0.05)[0].ravel())[1:]
    assert np.sum((sizes > 90) & (sizes < 130)) == 2 * len(SENSORS)
    assert (picture[..., 2] > picture[..., 0] + 0.2).mean() > 0.01


def test_each_node_of_a_network_is_a_dot_in_both_panels(biceps):
    picture = pixels(draw_network_nodes([network(8)], [network(8)], biceps["position"].values[0]))
    orange = (picture[..., 0] > picture[..., 2] + 0.25) & (picture[..., 0] > 0.7)
    sizes = np.bincount(label(orange)[0].ravel())[1:]
    assert np.sum(sizes > 20) == 16


def test_bars_are_as_high_as_the_errors():
    """Method b errs twice as much as a: so is its largest patch, a bar; the legend's are smaller."""
    picture = pixels(draw_error_bars(summaries()))
    drawn = [label(np.abs(picture - rgb(colour)).max(axis=2) < 0.01)[0] for colour in SERIES_COLOURS[:2]]
    first, second = (np.bincount(patches.ravel())[1:].max() for patches in drawn)
    assert second / first == pytest.approx(2, rel=0.03)


def test_a_heat_map_is_red_where_the_error_is_and_nodes_not_asked_are_grey(biceps):
    points, quads = biceps["position"].values[0], biceps["surface_quads"].values
    upper = points[:, 2] > -450
    picture = pixels(draw_heat_maps(points, quads, {"a": np.where(upper, 10.0, np.nan)}))
    rows = picture.shape[0]
    first_panel, columns = picture[: rows // 2], int(0.7 * picture.shape[1])
    red = (first_panel[..., 0] > first_panel[..., 1] + 0.3)[:, :columns].mean(axis=1)
    assert red[: rows // 4].mean() > 5 * red[rows // 3 :].mean()
    grey = np.ptp(picture[:, :columns], axis=2) < 0.06
    dull = grey & (picture[:, :columns].mean(axis=2) < 0.75) & (picture[:, :columns].mean(axis=2) > 0.4)
    assert dull.mean() > 0.02


def test_drawing_leaves_matplotlibs_global_state_alone(biceps):
    import matplotlib
    from matplotlib import pyplot

    matplotlib.rcdefaults()
    before = dict(matplotlib.rcParams)
    draw("heat", biceps)
    assert dict(matplotlib.rcParams) == before
    assert pyplot.get_fignums() == []


def test_importing_the_room_needs_no_matplotlib():
    code = "import sys, myograph.view; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("name", NAMES)
def test_without_matplotlib_the_message_says_what_to_install(name, biceps, monkeypatch):
    for module in [known for known in sys.modules if known.split(".")[0] == "matplotlib"]:
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingPackageError, match=r"'matplotlib': install it with  pip install 'myograph\[view\]'"):
        draw(name, biceps)


@pytest.mark.parametrize(
    ("drawing", "message"),
    [
        (lambda: draw_arm([]), "at least one surface"),
        (lambda: draw_heat_maps(np.zeros((4, 3)), np.array([[0, 1, 2, 3]]), {}), "at least one method"),
        (lambda: draw_error_bars({}), "at least one method"),
        (lambda: draw_error_bars({"affine": {}}), "at least one method"),
        (lambda: draw_lines([], "x", "angle"), "plot of angle: expected at least one line"),
        (lambda: draw_training({}), "at least one line"),
        (lambda: draw_network_nodes([], [], np.zeros((4, 3))), "got 0 and 0"),
        (lambda: draw_network_nodes([network(8)], [], np.zeros((4, 3))), "got 1 and 0"),
        (lambda: Line("table", np.zeros(3), np.zeros(2)), "line 'table'.*got 3 and 2"),
        (lambda: Line("table", np.zeros(0), np.zeros(0)), "line 'table'.*got 0 and 0"),
        (lambda: draw_moments(np.zeros(2), {}), "expected at least one line"),
        (lambda: draw_moments(np.zeros(2), {"biceps": dict.fromkeys((0.0, 0.2, 0.4, 0.6, 0.8), np.zeros(2))}), "got 5"),
    ],
)
def test_what_cannot_be_drawn_is_refused(drawing, message):
    with pytest.raises(InputError, match=message):
        drawing()


@pytest.mark.parametrize("errors", [np.zeros(5), np.full(4, np.nan)])
def test_a_heat_map_needs_an_error_for_its_nodes(errors):
    with pytest.raises(InputError, match="heat map of 'gen_8': expected errors of 4 nodes"):
        draw_heat_maps(np.zeros((4, 3)), np.array([[0, 1, 2, 3]]), {"gen_8": errors})
