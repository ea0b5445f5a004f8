"""Limbs of tabulated forces from files."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.interpolation import SparseGrid
from myograph.limb.force_limb import limb_from_forces, read_force_limb, read_table

TOML = """
name = "two muscles"
range_deg = [10, 150]

[load]
hand = 280.0

[muscles.extensor]
samples = "forces.csv"
column = "extensor_n"
acts = "extends"
lever_mm = [22.0, 0.1, -0.001]

[muscles.flexor]
samples = "forces.csv"
column = "flexor_n"
scale = -2.0
acts = "flexes"
lever_mm = [35.0]
"""


def write_limb(folder, toml=TOML, separator=","):
    """The file and its table: forces 300 + 500 a and, with the other sign and half the size, 300 + 500 a - 2 θ."""
    unit = SparseGrid.regular(2, 3).coordinates("clenshaw_curtis")
    angle, activation = 10 + 140 * unit[:, 0], unit[:, 1]
    rows = np.stack([angle, activation, 300 + 500 * activation, -(300 + 500 * activation - 2 * angle) / 2], axis=1)
    header = separator.join(["angle_deg", "activation", "extensor_n", "flexor_n"])
    lines = [separator.join(f"{value:.17g}" for value in row) for row in rows.tolist()]
    (folder / "forces.csv").write_text("\n".join([header if separator == "," else f"# {header}", *lines]) + "\n")
    path = folder / "limb.toml"
    path.write_text(toml)
    return path


@pytest.mark.parametrize("separator", [",", " ", "\t"])
def test_moments_are_scale_times_column_times_lever_with_the_muscles_sign(tmp_path, separator):
    spec = read_force_limb(write_limb(tmp_path, separator=separator))
    limb = limb_from_forces(spec, tmp_path)
    angle = np.radians([60.0])
    assert limb.names == ("extensor", "flexor")
    expected = [-(300 + 250) * (22 + 6 - 3.6), (300 + 500 * 0.5 - 120) * 35]
    assert limb.muscle_moments((0.5, 0.5), angle)[0] == pytest.approx(expected, rel=1e-9)
    assert limb.outside(np.array([np.pi / 2]), 10.0) == pytest.approx([-2800.0])


def test_a_forearms_mass_weighs_only_with_gravity(tmp_path):
    toml = TOML.replace("hand = 280.0", "hand = 280.0\nforearm_mass = 2.0\ncentre_of_mass = 150.0")
    spec = read_force_limb(write_limb(tmp_path, toml))
    level = np.array([np.pi / 2])
    assert limb_from_forces(spec, tmp_path).outside(level, 0.0) == pytest.approx([-2 * 9.80665 * 150])
    assert limb_from_forces(spec, tmp_path, gravity=False).outside(level, 0.0) == pytest.approx([0.0])


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('column = "flexor_n"', 'column = "flexor"', "forces.csv: expected a column 'flexor', got angle_deg, activ"),
        ('samples = "forces.csv"', 'samples = "none.csv"', "none.csv: cannot be read"),
        ("lever_mm", "leverr_mm", "unknown key 'muscles.extensor.leverr_mm'; did you mean 'lever_mm'?"),
        ("[10, 150]", "[150, 10]", "range_deg: expected increasing angles"),
        ("[10, 150]", "[20, 150]", "forces.csv, muscle 'extensor': expected a full grid"),
        ('acts = "flexes"', 'acts = "pulls"', "muscles.flexor.acts: .*'flexes' or 'extends'"),
        ("hand = 280.0", "hand = 280.0\nforearm_mass = 2.0", "expected forearm_mass and centre_of_mass together"),
    ],
)
def test_a_limb_file_with_a_mistake_is_refused_by_name(tmp_path, old, new, words):
    path = write_limb(tmp_path, TOML.replace(old, new))
    with pytest.raises(InputError, match=words):
        limb_from_forces(read_force_limb(path), tmp_path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "expected a header and rows of numbers, got 0 lines"),
        ("a,b\n1,2\n3\n", "line 3: expected 2 numbers, got 1"),
        ("a,b\n1,2\n3,x\n", "line 3: could not convert string to float: 'x'"),
    ],
)
def test_a_table_that_is_none_is_refused_with_its_line(tmp_path, text, words):
    path = tmp_path / "table.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=f"table.csv.*{words}"):
        read_table(path, ("a", "b"))


def test_comments_and_empty_lines_of_a_table_are_left_out(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("# a b\n\n1 2\n# 5 6\n3 4\n")
    assert read_table(path, ("b",)).tolist() == [[2.0], [4.0]]
