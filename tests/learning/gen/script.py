"""Compiled networks in a process where nothing checks types: python -m tests.learning.gen.script steps|nodes.

steps   prints errors of the steps of a plain and of a compiled training, and how many graphs were compiled in the
        training and by the end of a prediction after it
nodes   prints the gradient of the nodes of a plain and of a compiled network, for each representer
"""

import json
import sys

import numpy as np
import torch
from torch._dynamo.utils import counters

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.gen.network import GraphElementNetwork
from tests.learning.conftest import stand_in
from tests.learning.gen.conftest import FEW


def steps():
    cases = stand_in()
    sampler, strict = PairSampler(cases, random_sensors(cases.nodes)), split_pairs(cases, "strict")
    small = NetworkConfig(hidden=(8,), latent=8, rounds=1)
    plain = GenLearner(small, FEW).train(sampler, strict)
    compiled = GenLearner(small, FEW.model_copy(update={"compile": True})).train(sampler, strict)
    made = counters["stats"]["unique_graphs"]
    compiled.predictor.predict(sampler.batch(strict.test[:2]).question)
    rmse = {"plain": plain.history.rmse.tolist(), "compiled": compiled.history.rmse.tolist()}
    return {**rmse, "made": made, "after": counters["stats"]["unique_graphs"]}


def nodes():
    draw = torch.Generator().manual_seed(1)
    points, values, queries = (torch.rand(2, count, 3, generator=draw) for count in (9, 9, 20))
    return {
        representer: [gradient(representer, compiled, points, values, queries) for compiled in (False, True)]
        for representer in ("dense", "nearest", "barycentric")
    }


def gradient(representer, compiled, points, values, queries):
    network = GraphElementNetwork(NetworkConfig(nodes_per_axis=3, representer=representer), np.ones(3), [3], [3], 0)
    if compiled:
        network.compile(backend="eager")
    network([(points, values)], queries)[0].square().sum().backward()
    return network.nodes.grad.tolist()


if __name__ == "__main__":
    torch.set_num_threads(1)
    sys.stdout.write(json.dumps({"steps": steps, "nodes": nodes}[sys.argv[1]]()))
