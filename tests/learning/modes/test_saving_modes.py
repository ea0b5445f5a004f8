"""Neural modes as a saved model: the same answers from onnxruntime and from torch again."""

import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.loaded import load
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.saving import Training, load_torch, save_model
from tests.learning.modes.block import block


@pytest.mark.exhaustive
@pytest.mark.parametrize("settings", [{"reads": "both"}, {"reads": "sensors", "sensing": "surface_and_ridge"}])
def test_a_saved_model_answers_as_before(tmp_path, sampler, split, settings):
    config = ModesConfig(modes=4, width=4, members=2, steps=10, **settings)
    model = ModesLearner(config).fit(sampler, split)
    save_model(model, Training(sampler.cases, split), tmp_path / "model")
    question = sampler.batch(split.test[:3]).question
    wanted = model.predict(question)
    for again in (load(tmp_path / "model"), load_torch(tmp_path / "model")):
        found = again.predict(question)
        for name in ("position", "cauchy_stress"):
            assert np.allclose(found.values[name], wanted.values[name], atol=1e-3)
        assert np.allclose(found.deviation["position"], wanted.deviation["position"], atol=1e-3)


def test_deviations_survive_the_export_where_the_networks_miss_next_to_nothing(tmp_path):
    cases = block(support=0)
    few = PairSampler(cases, np.array([0, 8, 13, 20]))
    split = split_pairs(cases, "thesis")
    model = ModesLearner(ModesConfig(modes=4, width=4, members=2, steps=10)).fit(few, split)
    model.module.angle_misfit.fill_(2e-5)
    for parameter in model.module.angle.parameters():
        parameter.data[:] = parameter.data[:1].clone()
    assert save_model(model, Training(cases, split), tmp_path / "model").parity < 1e-5
