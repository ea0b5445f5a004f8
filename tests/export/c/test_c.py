"""A muscle in C: compiled without a warning, as exact as it says, small and quick."""

import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.export.c import Wanted, c_source, reduced_muscle
from myograph.export.c.reduced import at_nodes, on_surface, with_modes
from myograph.inference.low_rank import read_low_rank
from tests.inference.low_rank.stand_in import save_modes

MAIN = """
#include "biceps.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static float position[3 * BICEPS_NODES], stress[BICEPS_NODES];

int main(int count, char **words)
{
    float activation[5], load;
    if (count > 1) {
        const float some[5] = {0.1f, 0.2f, 0.7f, 0.4f, 0.3f};
        const clock_t start = clock();
        for (int i = 0; i < 1000; i++)
            biceps_predict(some, 5.0f + (float)i / 1000.0f, position, stress);
        printf("%g %s\\n", (double)(clock() - start) / CLOCKS_PER_SEC, words[0] ? biceps_sha256 : "");
        return 0;
    }
    while (scanf("%f %f %f %f %f %f", activation, activation + 1, activation + 2, activation + 3, activation + 4,
                 &load) == 6) {
        printf("%d %.9g", biceps_predict(activation, load, position, stress), biceps_elbow_angle(activation, load));
        for (int i = 0; i < 3 * BICEPS_NODES; i++)
            printf(" %.9g", position[i]);
        for (int i = 0; i < BICEPS_NODES; i++)
            printf(" %.9g", stress[i]);
        printf("\\n");
    }
    return 0;
}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O2")
ASKED = np.column_stack([np.random.default_rng(1).uniform(size=(20, 5)) * [1, 1, 1, 1, 0.5], np.linspace(0, 20, 20)])


@pytest.fixture(scope="module")
def muscle(tmp_path_factory):
    folder = tmp_path_factory.mktemp("modes") / "model"
    save_modes(folder)
    return read_low_rank(folder)


def compiled(found, folder):
    """The program above with the muscle in it."""
    if shutil.which("gcc") is None:
        pytest.skip("no gcc here")
    for name, text in {**c_source(found, "biceps").files, "main.c": MAIN}.items():
        (folder / name).write_text(text)
    command = ["gcc", *STRICT, "main.c", "biceps.c", "-lm", "-o", "program"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "program"


def answered(program, asked, nodes):
    """Verdicts, angles, positions and stresses."""
    text = "\n".join(" ".join(f"{value:.9g}" for value in row) for row in asked)
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    rows = np.array([[float(word) for word in line.split()] for line in done.stdout.splitlines()])
    return rows[:, 0], rows[:, 1], rows[:, 2 : 2 + 3 * nodes].reshape(len(rows), nodes, 3), rows[:, 2 + 3 * nodes :]


@pytest.fixture(scope="module", params=["float", "int8"])
def built(request, muscle, tmp_path_factory):
    found = reduced_muscle(muscle, Wanted(request.param, tolerance_mm=0.1, stress=True))
    return found, compiled(found, tmp_path_factory.mktemp(request.param))


def test_c_answers_as_python_within_what_the_header_says(built, muscle):
    found, program = built
    surface = on_surface(muscle)
    verdict, angles, positions, stresses = answered(program, ASKED, len(surface.reference))
    assert not verdict.any()
    for row, asked in enumerate(ASKED):
        full = surface.at(asked[:5], asked[5])
        assert angles[row] == pytest.approx(surface.elbow_angle(asked[:5], asked[5]), rel=1e-5)
        missed = np.linalg.norm(positions[row] - full["position"], axis=1).max()
        assert missed <= 1.2 * found.errors["position"] + 1e-3
        assert np.abs(stresses[row] - full["von_mises"]).max() <= 1.2 * found.errors["von_mises"] + 1e-5


def test_float_is_the_same_as_python_with_as_many_modes(muscle, tmp_path):
    found = reduced_muscle(muscle, Wanted(tolerance_mm=None, stress=True))
    assert found.modes["position"] == len(muscle.fields["position"].modes)
    cut = on_surface(muscle)
    fields = {
        name: with_modes(cut.fields[name], found.modes[told])
        for name, told in (("position", "position"), ("cauchy_stress", "von_mises"))
    }
    cut = replace(cut, fields=fields)
    _, _, positions, stresses = answered(compiled(found, tmp_path), ASKED, len(cut.reference))
    for row, asked in enumerate(ASKED):
        wanted = cut.at(asked[:5], asked[5])
        for values, name in ((positions[row], "position"), (stresses[row], "von_mises")):
            assert np.abs(values - wanted[name]).max() <= 1e-5 * np.abs(wanted[name]).max()


def test_what_is_outside_or_no_number_is_said(built, muscle):
    nodes = len(on_surface(muscle).reference)
    asked = np.array([[0, 0, 0, 0, 0.6, 0], [0, 0, 0, 0, 0, 21], [np.nan, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, np.inf]])
    verdict, _, positions, _ = answered(built[1], asked, nodes)
    assert verdict.tolist() == [1, 1, 2, 2]
    assert np.array_equal(positions[2], positions[1])


def test_a_prediction_takes_less_than_a_millisecond_and_tells_the_models_checksum(built, muscle):
    done = subprocess.run([built[1], "time"], capture_output=True, text=True, check=True)
    seconds, checksum = done.stdout.split()
    assert float(seconds) < 1.0
    assert checksum == muscle.checksum


def test_the_size_is_that_of_the_arrays_in_the_object(built):
    found, program = built
    subprocess.run(["gcc", *STRICT, "-c", "biceps.c"], cwd=program.parent, check=True)
    done = subprocess.run(["size", "biceps.o"], cwd=program.parent, capture_output=True, text=True, check=True)
    text, data = (int(word) for word in done.stdout.splitlines()[1].split()[:2])
    assert found.bytes < text + data < found.bytes + 8 * len(found.muscle.skin) + 12000


def test_fewer_modes_for_a_wider_tolerance_and_a_smaller_size(muscle):
    fine, coarse = (reduced_muscle(muscle, Wanted(tolerance_mm=size)) for size in (0.01, 3.0))
    assert coarse.modes["position"] < fine.modes["position"]
    assert coarse.errors["position"] <= 3.0
    limited = reduced_muscle(muscle, Wanted(tolerance_mm=None, most_kb=coarse.bytes / 1000))
    assert limited.modes == coarse.modes
    assert reduced_muscle(muscle, Wanted("int8", tolerance_mm=0.01)).bytes < fine.bytes


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        (Wanted(tolerance_mm=0.01, most_kb=7.0), r"within 0.01 mm and at most 7 kB, got .* allow more of either"),
        (Wanted("int8", tolerance_mm=1e-7), "expected modes within 1e-07 mm, got"),
        (Wanted(most_kb=0.5), "expected room for one mode at least"),
        (Wanted(tolerance_mm=-1.0), "tolerance: expected a number above 0, got -1"),
    ],
)
def test_what_cannot_be_met_is_refused_with_what_can(muscle, wanted, words):
    with pytest.raises(InputError, match=words):
        reduced_muscle(muscle, wanted)


def test_models_without_surface_or_stress_and_names_that_c_refuses_are_refused(muscle):
    bare = replace(muscle, skin=muscle.skin[:0])
    with pytest.raises(InputError, match="expected a model that knows the surface"):
        reduced_muscle(bare, Wanted())
    few = at_nodes(bare, np.arange(12))
    found = reduced_muscle(few, Wanted(surface=False))
    assert "BICEPS_FACETS 0" in c_source(found, "biceps").files["biceps.h"]
    with pytest.raises(InputError, match="expected a model with stress, got one of position"):
        reduced_muscle(replace(few, fields={"position": few.fields["position"]}), Wanted(surface=False, stress=True))
    with pytest.raises(InputError, match="name in C: expected a letter"):
        c_source(found, "my-biceps")
