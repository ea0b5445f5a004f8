"""Every baseline that is a module answers in onnxruntime as in torch, for free numbers of pairs and queries."""

import pytest

from myograph.learning.baselines.deeponet import DeepONet
from myograph.learning.baselines.deeponet_module import DeepONetConfig
from myograph.learning.baselines.feed_forward import FeedForward
from myograph.learning.baselines.gp_module import PodGpConfig
from myograph.learning.baselines.pod_gp import PodGp
from myograph.learning.onnx_export import export
from myograph.learning.training import TrainingConfig
from tests.learning.baselines.stand_in import stand_in_sampler

FEW = TrainingConfig(steps=3, batch=8, queries=16)
LEARNERS = [
    FeedForward(training=FEW),
    PodGp(PodGpConfig(modes=4, most_cases=40, kernel_cases=20)),
    DeepONet(DeepONetConfig(drive="both", terms=4, branch=(8,), trunk=(8,)), FEW),
]


@pytest.mark.parametrize("learner", LEARNERS, ids=lambda learner: learner.name)
def test_onnxruntime_and_torch_give_the_same(learner, body_cases, off_grid):
    convention = "initial" if learner.name == "pod_gp" else "material"
    sampler = stand_in_sampler(convention, ("position", "von_mises"), body_cases)
    exported = export(learner.fit(sampler, off_grid), body_cases, off_grid)
    assert exported.parity < 1e-5
