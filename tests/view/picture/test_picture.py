"""Pictures in three dimensions: what is drawn is where it should be, in its colour; films move."""

import subprocess
import sys

import numpy as np
import pytest

from myograph.errors import InputError, MissingPackageError
from myograph.view.picture import CAMERAS, Panel, Solid, Stage, named_camera, write_film
from myograph.view.picture.solid import colours_of
from myograph.view.picture.stage import Setting
from myograph.view.surface import capsule

DRAW = """
import sys
import numpy as np
from myograph.view.picture import Panel, Solid, Stage, named_camera, png_bytes, write_film
from myograph.view.picture.solid import colours_of
from myograph.view.picture.stage import Setting
from myograph.view.surface import capsule
from pathlib import Path

def panel(height, value):
    shape = capsule(np.zeros(3), np.array([0.0, 0, height]), 10.0, "a", "#d55e00")
    values = None if value is None else np.full(len(shape.points), value)
    return Panel("a title", [Solid("a", shape.points, shape.quads, "#d55e00", values)])

out = Path(sys.argv[1])
plain = Stage([panel(100.0, None)], Setting(named_camera("lateral"), (200, 300)))
images = [plain.image([panel(height, None)]) for height in (100.0, 60.0)]
plain.close()
panels = [panel(100.0, 0.0), panel(100.0, 1.0)]
coloured = Stage(panels, Setting(named_camera("front"), (400, 300), 2), colours_of("a field [mm]", panels))
sheet = coloured.image(panels)
coloured.close()
np.savez(out / "images.npz", long=images[0], short=images[1], sheet=sheet)
write_film(out / "film.gif", images, 5.0)
(out / "sheet.png").write_bytes(png_bytes(sheet))
"""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """In a process of its own, for VTK and NGSolve do not live together everywhere."""
    pytest.importorskip("pyvista", reason="pictures in three dimensions are drawn by PyVista")
    out = tmp_path_factory.mktemp("drawn")
    done = subprocess.run([sys.executable, "-c", DRAW, out], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return out


@pytest.fixture(scope="module")
def images(drawn):
    with np.load(drawn / "images.npz") as found:
        return dict(found)


def reddish(image):
    """Pixels of the solid's own colour, in light or in shade."""
    red, green, blue = np.moveaxis(image.astype(int), -1, 0)
    return (red > 1.5 * green) & (red > 2 * blue)


def solid(values=None):
    shape = capsule(np.zeros(3), np.array([0.0, 0, 50]), 5.0, "a", "#d55e00")
    return Solid("a", shape.points, shape.quads, shape.colour, values)


def test_the_solid_is_as_long_and_wide_as_it_is(images):
    seen = reddish(images["long"])
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    assert np.ptp(rows) / np.ptp(columns) == pytest.approx(120 / 20, rel=0.05)
    assert columns.mean() == pytest.approx(100, abs=3)


def test_the_scale_stays_when_the_solid_changes(images):
    tall, short = (np.ptp(np.flatnonzero(reddish(images[name]).any(axis=1))) for name in ("long", "short"))
    assert short / tall == pytest.approx(80 / 120, rel=0.03)


def test_values_become_colours_of_one_bar_for_all_panels(images):
    left, right = images["sheet"][130:170, 90:110], images["sheet"][130:170, 290:310]
    dark, bright = (part.reshape(-1, 3).mean(axis=0) for part in (left, right))
    assert dark[1] < 60
    assert bright[1] > 120
    assert bright[2] < bright[1] / 2


def test_a_film_has_all_images_and_they_differ(drawn):
    from PIL import Image

    with Image.open(drawn / "film.gif") as film:
        assert (film.n_frames, film.info["duration"]) == (2, 200)


def test_every_camera_looks_from_somewhere_else():
    towards = [named_camera(name).towards for name in CAMERAS]
    assert len({tuple(np.round(direction, 3)) for direction in towards}) == len(CAMERAS)
    with pytest.raises(InputError, match="camera: expected one of oblique"):
        named_camera("inside")


def test_a_bar_over_decades_is_logarithmic():
    wide = colours_of("s", [Panel("", [solid(np.geomspace(1e-6, 10, 930))])])
    assert (wide.logarithmic, wide.least, wide.largest) == (True, pytest.approx(0.01), pytest.approx(10))
    narrow = colours_of("s", [Panel("", [solid(np.linspace(1, 2, 930))])])
    assert (narrow.logarithmic, narrow.least, narrow.largest) == (False, 1, 2)
    assert colours_of("s", [Panel("", [solid(np.full(930, 3.0))])]).largest == 4
    assert colours_of("s", [Panel("", [solid()])]) is None


def test_what_cannot_be_drawn_is_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match="expected a body with a surface"):
        Solid("a", np.zeros((3, 3)), np.zeros((0, 4), dtype=int), "#ffffff")
    with pytest.raises(InputError, match="expected panels with solids, got 0"):
        Stage([], Setting(named_camera("front"), (100, 100)))
    with pytest.raises(InputError, match="expected 64 to 8192 pixels"):
        Stage([Panel("", [solid()])], Setting(named_camera("front"), (10, 100)))
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[view\]"):
        Stage([Panel("", [solid()])], Setting(named_camera("front"), (100, 100)))


def test_films_of_other_kinds_without_images_and_without_imageio_are_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match=r"expected a film such as film\.gif"):
        write_film(tmp_path / "film.avi", [], 10.0)
    with pytest.raises(InputError, match="expected at least one image"):
        write_film(tmp_path / "film.gif", [], 10.0)
    monkeypatch.setitem(sys.modules, "imageio", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[film\]"):
        write_film(tmp_path / "film.mp4", [], 10.0)


def test_an_mp4_is_written_where_imageio_is(tmp_path):
    pytest.importorskip("imageio_ffmpeg")
    frames = [np.full((65, 97, 3), level, dtype=np.uint8) for level in (0, 120, 250)]
    assert write_film(tmp_path / "film.mp4", frames, 10.0) == 3
    assert b"ftyp" in (tmp_path / "film.mp4").read_bytes()[:16]
