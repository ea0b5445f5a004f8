"""Networks on the stand-in muscle."""

import pytest

from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.training import TrainingConfig

FEW = TrainingConfig(steps=4, batch=4, queries=16, triangulate_every=2, device="cpu")
KINDS = {
    "thesis": NetworkConfig.thesis(),
    "improved": NetworkConfig.improved(),
    "many": NetworkConfig(
        inputs=(("coordinates", "von_mises"), ("displacement",)),
        outputs=(("direction_and_scale",), ("cauchy_stress", "von_mises")),
        processor="mpnn",
        representer="nearest",
        nearest=4,
        sharpness="per_node",
    ),
    "both": NetworkConfig(
        activation_input=True, reads="sensors_and_activation", representer="barycentric", nodes_per_axis=3
    ),
    "ChebConv": NetworkConfig(processor="ChebConv"),
}
"""Networks that between them use every switch, traps aside."""


@pytest.fixture(scope="session")
def stressed(sampler):
    """The standard sampler, with stress known and asked."""
    everything = ("position", "cauchy_stress", "von_mises")
    return type(sampler)(sampler.cases, sampler.sensors, "initial", everything, everything)


@pytest.fixture(scope="session")
def gen_8(sampler, strict):
    """The default network, trained for some seconds."""
    training = TrainingConfig(steps=300, device="cpu")
    return GenLearner(training=training).train(sampler, strict)


@pytest.fixture(scope="session", params=KINDS)
def kind(request):
    """A name in KINDS; that of PyTorch Geometric only where that is installed."""
    if request.param == "ChebConv":
        pytest.importorskip("torch_geometric")
    return request.param


@pytest.fixture(scope="session")
def briefly_trained(kind, stressed, strict):
    """One of KINDS after a few steps."""
    return GenLearner(KINDS[kind], FEW).train(stressed, strict)
