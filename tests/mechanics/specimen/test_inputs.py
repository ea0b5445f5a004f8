"""Specimens and loads that make no sense are refused before anything is solved."""

import pytest

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")

from myograph.errors import InputError
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.mechanics.specimen import Box, Load, Panel, Specimen, ThickSphere, solve

RUBBER = MooneyRivlin(c1=1.0, K=1000.0)
NAN = float("nan")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: Specimen(Box(), RUBBER, fibre=(1.0, 1.0, 0.0)),
            r"fibre direction: expected a unit vector.*length 1.41",
        ),
        (lambda: Specimen(Box(), RUBBER, fibre=(NAN, 0.0, 0.0)), "fibre direction"),
        (
            lambda: Specimen(Box(), RUBBER, symmetry=("left",)),
            "unknown plane of symmetry 'left': expected one of x_max",
        ),
        (lambda: Specimen(ThickSphere(1.0, 2.0), RUBBER, symmetry=("inner",)), "unknown plane of symmetry 'inner'"),
        (lambda: Load(activation=1.5), r"activation of the specimen: expected a number in \[0, 1\], got 1.5"),
        (lambda: Load(activation=-0.1), "activation of the specimen"),
        (lambda: Load(displacement={"x_max": (NAN, None, None)}), r"displacement of x_max \[mm\]: expected finite"),
        (lambda: Load(traction={"x_max": (float("inf"), 0.0, 0.0)}), r"traction on x_max \[MPa\]: expected finite"),
        (lambda: Load(pressure={"x_max": NAN}), r"pressure on x_max \[MPa\]: expected finite"),
        (
            lambda: Load(gradient=((-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))),
            "gradient: expected a positive determinant",
        ),
        (
            lambda: Load(
                gradient=((1.1, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), displacement={"x_max": (0.1, None, None)}
            ),
            "expected no displacement beside it",
        ),
    ],
)
def test_a_description_that_cannot_be_is_refused(make, words):
    with pytest.raises(InputError, match=words):
        make()


CUBE = Specimen(Box(), RUBBER)


@pytest.mark.parametrize(
    ("specimen", "load", "words"),
    [
        (
            CUBE,
            Load(displacement={"top": (0.1, None, None)}),
            "unknown face of the displacement 'top': expected one of x_",
        ),
        (CUBE, Load(traction={"top": (0.1, 0.0, 0.0)}), "unknown face of the traction 'top'"),
        (CUBE, Load(pressure={"top": 0.1}), "unknown face of the pressure 'top'"),
        (
            Specimen(Box(), RUBBER, symmetry=()),
            Load(displacement={"x_max": (0.1, None, None)}),
            "but 3 of its 6 rigid motions are free; add planes of symmetry",
        ),
        (Specimen(Box(), RUBBER, symmetry=()), Load(traction={"x_max": (0.1, 0.0, 0.0)}), "6 of its 6 rigid motions"),
        (
            Specimen(Panel(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))), RUBBER, symmetry=("z_min", "z_max")),
            Load(traction={"x_max": (0.1, 0.0, 0.0)}),
            "3 of its 6 rigid motions",
        ),
        (
            Specimen(Box(), RUBBER, symmetry=("y_min", "z_min")),
            Load(displacement={"x_max": (0.1, None, None), "y_max": (0.2, None, None)}),
            "face y_max: expected one x displacement where faces meet, got 0.2 and 0.1 mm",
        ),
        (CUBE, Load(displacement={"y_max": (0.1, None, None)}), "got 0.1 and 0 mm; leave one of them free"),
    ],
)
def test_a_load_that_does_not_fit_the_specimen_is_refused(specimen, load, words):
    with pytest.raises(InputError, match=words):
        solve(specimen, load)


def test_at_least_one_load_step_is_needed():
    with pytest.raises(InputError, match="load steps: expected a whole number from 1 on, got 0"):
        solve(CUBE, Load(), steps=0)


def test_a_point_that_is_no_vertex_names_the_nearest():
    state = solve(CUBE, Load(activation=1.0))
    with pytest.raises(InputError, match=r"expected a vertex of the mesh, the nearest is \(1.0, 1.0, 0.0\)"):
        state.displacement_at((0.9, 0.8, 0.1))
