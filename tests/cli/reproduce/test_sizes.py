"""How large the reproduction is."""

from dataclasses import replace

import pytest

from myograph.cli.reproduce.sizes import reproduction_size
from myograph.errors import InputError


def test_larger_graphs_get_fewer_steps():
    size = reproduction_size("thesis")
    assert [size.training(axis)["steps"] for axis in (2, 3, 7)] == [3000, 2250, 1125]
    assert {size.training(axis)["batch"] for axis in (2, 3, 7)} == {8}


def test_how_long_networks_are_trained_is_told():
    told = reproduction_size("quick").trained
    assert told.startswith(
        "graphs of 8 nodes 1,000, of 27 nodes 750, of 64 nodes 600, of 343 nodes 375, each of 4 pairs;"
    )
    assert "in 6.2.4 graphs have 64 nodes; feed-forward network 300" in told


def test_other_sizes_have_another_checksum():
    size = reproduction_size("quick")
    assert replace(size, steps=999).checksum != size.checksum
    assert replace(size).checksum == size.checksum


def test_an_unknown_preset_is_refused():
    with pytest.raises(InputError, match="unknown preset 'slow': expected one of tiny, quick, thesis"):
        reproduction_size("slow")
