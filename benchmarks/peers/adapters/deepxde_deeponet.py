"""DeepXDE: its deep operator network, branch of activations, trunk of material places, one network a component."""

import os

os.environ["DDE_BACKEND"] = "pytorch"

import torch
from deepxde.nn.pytorch import DeepONetCartesianProd

from adapters.stepwise import places, train

DOES = {"package": "deepxde", "anywhere": True, "reads": "activations"}
WIDTH = 64


def fit(task):
    """Trained by the common loop, as DeepXDE's own data class takes one output only."""
    torch.manual_seed(task.seed)
    layers = [WIDTH, WIDTH, WIDTH]
    network = DeepONetCartesianProd(
        [5, *layers], [3, *layers], "relu", "Glorot normal", num_outputs=4, multi_output_strategy="independent"
    )
    where = places(task)
    return train(network, lambda activation: network((activation, where)), task)
