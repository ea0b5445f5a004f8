"""Neural modes as a saved model: the same answers from onnxruntime and from torch again."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.saving import Training, save_model
from tests.learning.modes.block import block


@pytest.mark.slow
def test_saved_models_answer_as_before_however_they_are_told(tmp_path):
    command = [sys.executable, "-m", "tests.learning.modes.script", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)
    assert len(rows) == 4
    for row in rows:
        assert row["parity"] < 1e-5
        assert row["apart"] < 2e-5


def test_deviations_survive_the_export_where_the_networks_miss_next_to_nothing(tmp_path):
    cases = block(support=0)
    few = PairSampler(cases, np.array([0, 8, 13, 20]))
    split = split_pairs(cases, "thesis")
    model = ModesLearner(ModesConfig(modes=4, width=4, members=2, steps=10)).fit(few, split)
    model.module.angle_misfit.fill_(2e-5)
    for parameter in model.module.angle.parameters():
        parameter.data[:] = parameter.data[:1].clone()
    assert save_model(model, Training(cases, split), tmp_path / "model").parity < 1e-5
