"""The table of verbs: each is there, and none costs another anything."""

import subprocess
import sys

import pytest

from myograph.cli.verbs import VERBS, Verbs


@pytest.mark.parametrize("name", VERBS)
def test_every_verb_says_what_it_does(name):
    command = Verbs(name="myograph").get_command(None, name)
    assert command.name == name
    assert command.get_short_help_str()


def test_an_unknown_verb_is_none_of_them():
    assert Verbs(name="myograph").get_command(None, "tabel") is None


HEAVY = "import sys, myograph.cli; sys.exit(' '.join({'xarray', 'zarr', 'scipy', 'onnxruntime'} & set(sys.modules)))"


def test_the_version_waits_for_no_verb():
    run = subprocess.run([sys.executable, "-c", HEAVY], capture_output=True, text=True, check=False)
    assert not run.stderr.strip()
