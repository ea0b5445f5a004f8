"""Laws by name, and what they refuse."""

import re

import pytest
from pydantic import ValidationError

from myograph.config import Model, parse
from myograph.errors import InputError
from myograph.materials.catalogue import LAWS, AnyLaw
from tests.materials.cases import EXAMPLES


class _Tissue(Model):
    belly: AnyLaw


def _refused(message, **belly):
    with pytest.raises(InputError, match=re.escape(message)):
        parse({"belly": belly}, _Tissue, "arm.toml")


def test_every_law_has_a_name_and_an_example():
    assert {law.law for law in EXAMPLES.values()} == set(LAWS)


@pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_a_law_survives_the_way_through_a_file(law):
    read = parse({"belly": law.model_dump(mode="json")}, _Tissue, "arm.toml")
    assert read.belly == law


def test_an_unknown_law_is_refused_with_the_known_ones():
    _refused("'roehrle', 'heidlauf_roehrle'", law="rohrle")


def test_a_parameter_of_another_law_is_refused():
    _refused("unknown key 'belly.neo_hooke.c1'", law="neo_hooke", E=1.0, nu=0.3, c1=1.0)


def test_a_missing_parameter_is_named():
    _refused("belly.neo_hooke.nu: Field required", law="neo_hooke", E=1.0)


@pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_a_negative_parameter_is_refused_by_its_name(law):
    for name, value in law.model_dump().items():
        if isinstance(value, float):
            with pytest.raises(ValidationError, match=rf"\n{name}\n"):
                type(law).model_validate(law.model_dump() | {name: -abs(value) - 1.0})


@pytest.mark.parametrize("name", sorted(EXAMPLES.keys() - {"neo_hooke isotropic", "neo_hooke fibre"}))
def test_a_bulk_modulus_that_would_not_keep_the_volume_is_refused_with_the_one_that_would(name):
    law = EXAMPLES[name]
    data = law.model_dump()
    key = "bulk" if "bulk" in data else "K"
    with pytest.raises(ValidationError, match=rf"{key}: expected at least 100 times .* less than 1e-3") as caught:
        type(law).model_validate(data | {key: 99 * law.shear_modulus})
    wanted = float(re.search(r"give (\S+) MPa or more", str(caught.value)).group(1))
    assert wanted == pytest.approx(100 * law.shear_modulus, rel=1e-5)
    type(law).model_validate(data | {key: 1.001 * wanted})


def test_a_straight_part_before_the_optimum_is_refused():
    data = EXAMPLES["blemker muscle"].model_dump() | {"l_star": 1.0}
    _refused("l_star: expected a stretch beyond L_ofl = 1.07", **data)
