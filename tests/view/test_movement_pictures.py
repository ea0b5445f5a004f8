"""Pictures of movements and equilibria: they show what they are given, and refuse what they cannot show."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.view import draw_equilibria, draw_film, draw_moments, draw_movement
from myograph.view.palette import MUSCLE_COLOURS, SERIES_COLOURS, UNKNOWN, muscle_colours
from tests.view.test_pictures import arm, pixels, rgb

TIMES = np.linspace(0, 1, 21)
ACTIVATIONS = {"biceps": TIMES, "triceps": 0.5 - 0.5 * TIMES}
MOMENTS = {"biceps": 8 * TIMES, "triceps": -3 + 0 * TIMES}
LEVELS = np.linspace(0, 1, 11)


def _near(picture, colour, tolerance=0.04):
    return np.abs(picture - rgb(colour)).max(axis=2) < tolerance


def _movement(**changes):
    given = {"excitations": None, **changes}
    return draw_movement(TIMES, 40 + 50 * TIMES, ACTIVATIONS, MOMENTS, -5 * TIMES, **given)


@pytest.mark.parametrize(
    "draw",
    [
        _movement,
        lambda: draw_equilibria(LEVELS, LEVELS, 30 + 80 * LEVELS[:, None] - 20 * LEVELS),
        lambda: draw_moments(TIMES, {"deltoid": {1.0: TIMES}, "biceps": {1.0: -TIMES}}),
    ],
    ids=["movement", "equilibria", "moments of other muscles"],
)
def test_a_picture_is_the_same_twice_and_shows_something(draw):
    first = draw()
    assert first == draw()
    assert 0.02 < (pixels(first) < 0.9).any(axis=2).mean() < 0.98


def test_each_muscle_is_drawn_in_its_hue_and_excitations_add_ink():
    picture = pixels(_movement())
    for name in ACTIVATIONS:
        assert _near(picture, MUSCLE_COLOURS[name]).sum() > 500
    dotted = pixels(_movement(excitations={name: 1 - values for name, values in ACTIVATIONS.items()}))
    assert (dotted < 0.9).any(axis=2).sum() > (picture < 0.9).any(axis=2).sum()


def test_where_nothing_rests_the_surface_is_grey_as_large_as_it_is():
    angle = 30 + 80 * LEVELS[:, None] - 20 * LEVELS
    holed = angle.copy()
    holed[LEVELS > 0.75] = np.nan
    shares = [_near(pixels(draw_equilibria(LEVELS, LEVELS, a)), UNKNOWN).mean() for a in (angle, holed)]
    assert shares[0] < 0.002
    assert 0.05 < shares[1] < 0.2


def test_a_film_shows_every_state_beside_the_one_before(biceps):
    one = arm(biceps)
    strip = pixels(draw_film([one, one, one], ["0 s", "1 s", "2 s"]))
    muscle = _near(strip, MUSCLE_COLOURS["biceps"], 0.2)[: int(0.9 * len(strip))]
    thirds = np.array_split(muscle, 3, axis=1)
    assert min(third.sum() for third in thirds) > 0.9 * max(third.sum() for third in thirds) > 1000


def test_muscles_of_other_limbs_get_colours_of_their_own():
    colours = muscle_colours(["flexor", "biceps", "extensor"])
    assert colours["biceps"] == MUSCLE_COLOURS["biceps"]
    assert len(set(colours.values())) == 3
    assert set(colours.values()) <= {*SERIES_COLOURS, *MUSCLE_COLOURS.values()}


@pytest.mark.parametrize(
    ("drawing", "message"),
    [
        (lambda: draw_equilibria(LEVELS, LEVELS, np.full((11, 11), np.nan)), "expected at least one angle at rest"),
        (lambda: draw_movement(TIMES[:1], TIMES[:1], {"a": TIMES[:1]}, {"a": TIMES[:1]}, TIMES[:1]), "got 1 times"),
        (lambda: draw_movement(TIMES, TIMES, {"a": TIMES}, {"b": TIMES}, TIMES), "of the same muscles; got 21"),
        (lambda: draw_film([], []), "got 0 states and 0 titles"),
        (lambda: draw_film([[]], ["0 s"]), "states with surfaces"),
    ],
)
def test_what_cannot_be_drawn_is_refused(drawing, message):
    with pytest.raises(InputError, match=message):
        drawing()
