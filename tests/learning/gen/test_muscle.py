"""The module in mm: what it takes and gives by name, and what it refuses."""

import pytest

from myograph.errors import InputError
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.muscle import MuscleGen, input_names, output_names
from myograph.learning.gen.scaling import blank_scaling

POSITIONS = ("sensor_places", "sensor_position_initial", "sensor_position_target")


def module(**config):
    told = NetworkConfig(**config)
    return MuscleGen(told, blank_scaling({kind for kinds in (*told.inputs, *told.outputs) for kind in kinds}), seed=0)


def test_the_thesis_network_reads_places_and_target_positions_only():
    assert input_names(NetworkConfig.thesis()) == ("sensor_places", "sensor_position_target", "query_places")


def test_displacements_need_initial_positions_too():
    assert input_names(NetworkConfig()) == (*POSITIONS, "query_places", "query_position_initial")


def test_activations_come_first_and_may_come_alone():
    known = {"activation_input": True, "outputs": (("von_mises",),)}
    both = NetworkConfig(**known, reads="sensors_and_activation")
    assert input_names(both) == ("activation", *POSITIONS, "query_places")
    assert input_names(NetworkConfig(**known, reads="activation")) == ("activation", "query_places")
    assert input_names(NetworkConfig(**known)) == (*POSITIONS, "query_places")


def test_outputs_are_named_by_their_fields():
    config = NetworkConfig(outputs=(("direction_and_scale", "von_mises"), ("cauchy_stress",)))
    assert output_names(config) == ("position", "von_mises", "cauchy_stress")
    assert [decoder[-1].out_features for decoder in module(outputs=config.outputs).network.decoders] == [5, 6]


@pytest.mark.parametrize("outputs", [(), ((),), (("von_mises",), ()), (("displacement",), ("coordinates",))])
def test_no_outputs_or_two_of_one_field_are_an_input_error(outputs):
    with pytest.raises(InputError, match="outputs: expected features of different fields"):
        module(outputs=outputs)


@pytest.mark.parametrize("inputs", [(), ((),), (("displacement",), ())])
def test_no_inputs_are_an_input_error(inputs):
    with pytest.raises(InputError, match="inputs: expected features at the sensors, got none"):
        module(inputs=inputs)


def test_reading_activations_without_an_input_for_them_is_an_input_error():
    with pytest.raises(InputError, match="reads 'activation': expected a network with an activation input"):
        module(reads="activation")


@pytest.mark.parametrize(
    "config",
    [{"outputs": (("coordinates",),)}, {"activation_input": True}],
)
def test_an_affine_skip_without_displacements_or_with_an_activation_input_is_an_input_error(config):
    with pytest.raises(InputError, match="skip 'affine'"):
        module(skip="affine", **config)
