"""Compiled networks: the steps run what was compiled, and learn what plain ones learn."""

import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.physics.config import Physics
from tests.learning.gen.conftest import FEW


def told(what):
    """What the script says; the checks of types that tests run with cannot be compiled."""
    command = [sys.executable, "-m", "tests.learning.gen.script", what]
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.exhaustive
@pytest.mark.skipif(shutil.which("g++") is None, reason="there is no C++ compiler")
def test_the_steps_of_a_training_run_what_was_compiled_and_predictions_do_not():
    found = told("steps")
    assert found["made"] > 0
    assert found["after"] == found["made"]
    np.testing.assert_allclose(found["compiled"], found["plain"], rtol=1e-3)


@pytest.mark.exhaustive
def test_nodes_of_a_compiled_network_receive_the_gradient_of_a_plain_one():
    for plain, compiled in told("nodes").values():
        assert np.abs(plain).max() > 1e-4
        np.testing.assert_allclose(compiled, plain, rtol=1e-4, atol=1e-6)


def test_derivatives_of_derivatives_are_not_compiled(sampler, strict):
    compiled = FEW.model_copy(update={"compile": True})
    with pytest.raises(InputError, match=r"compile: with physics\.volume .* set volume to 0, or compile to false"):
        GenLearner(NetworkConfig(physics=Physics(volume=0.1)), compiled).fit(sampler, strict)
