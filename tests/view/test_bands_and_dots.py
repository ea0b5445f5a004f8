"""Lines with bands, and dots of errors: what is drawn, and what is refused."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.evaluation import ErrorSummary
from myograph.view.bands import Axes, Band, draw_bands
from myograph.view.dots import draw_error_dots

X = np.array([1.0, 2.0, 4.0])
AXES = Axes("steps", "error [mm]", log_x=True)


def pixels(png):
    import io

    from matplotlib.image import imread

    return imread(io.BytesIO(png))[..., :3]


def coloured(png, colour):
    from matplotlib.colors import to_rgb

    return int((np.abs(pixels(png) - to_rgb(colour)).max(axis=-1) < 0.02).sum())


def test_a_line_is_drawn_in_its_colour_and_its_band_paler():
    alone = draw_bands([Band("a", X, X, colour="#0072b2")], AXES)
    banded = draw_bands([Band("a", X, X, X / 2, X * 2, colour="#0072b2")], AXES)
    assert coloured(alone, "#0072b2") > 500
    blue = (pixels(banded)[..., 2] - pixels(banded)[..., 0] > 0.05).sum()
    assert blue > 5 * (pixels(alone)[..., 2] - pixels(alone)[..., 0] > 0.05).sum()


def test_lines_without_points_and_plots_without_lines_are_refused():
    with pytest.raises(InputError, match="as many x as y, and some; got 3 and 2"):
        Band("a", X, X[:2])
    with pytest.raises(InputError, match="at least one line"):
        draw_bands([], AXES)


def test_every_method_has_a_line_and_every_protocol_a_colour():
    found = ErrorSummary(1.0, 1.2, 3.0, 5.0, 0.1)
    one = draw_error_dots({"a": {"strict": found}})
    two = draw_error_dots({"a": {"strict": found, "thesis": found}, "b": {"strict": found}, "c": {}})
    assert pixels(two).shape[0] > pixels(one).shape[0]
    assert coloured(one, "#d55e00") == 0
    assert coloured(two, "#d55e00") > 0.8 * coloured(one, "#0072b2")
    assert coloured(two, "#0072b2") > coloured(one, "#0072b2")


def test_dots_of_nothing_are_refused():
    with pytest.raises(InputError, match="at least one method"):
        draw_error_dots({"a": {}})


@pytest.mark.parametrize(("low", "high", "told"), [(0.7, 1.7, [0.7, 1, 1.5]), (0.03, 30, [0.05, 0.1, 0.2, 0.5, 1])])
def test_a_narrow_axis_tells_more_numbers(monkeypatch, low, high, told):
    drawn = []
    monkeypatch.setattr("myograph.view.bands.png", lambda figure: drawn.append(figure) or b"")
    draw_bands([Band("a", np.arange(2), np.array([low, high]))], Axes("x", "y"))
    ticks = [tick for tick in drawn[0].axes[0].get_yticks() if low <= tick <= high]
    assert ticks[: len(told)] == pytest.approx(told)
