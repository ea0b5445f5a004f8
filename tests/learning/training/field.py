"""The smallest thing to train: an MLP from activations and material points to where these go."""

import math

import numpy as np
import torch
from torch import nn

from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.learning.training.drawing import draw_batch, hold_out
from myograph.learning.training.trainable import device_of

LENGTH = 100.0  # mm


class FieldModule(nn.Module):
    def __init__(self, seed, dropout=0.0):
        super().__init__()
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(seed)
            self.layers = nn.Sequential(nn.Linear(8, 32), nn.Tanh(), nn.Dropout(dropout), nn.Linear(32, 3))

    def forward(self, activation, places):
        told = activation[:, None].expand(-1, places.shape[1], -1)
        return LENGTH * self.layers(torch.cat([told, places / LENGTH], dim=-1))


class Field:
    """A `Trainable`."""

    def __init__(self, cases, split, config, dropout=0.0):
        self.sampler = PairSampler(cases, random_sensors(cases.nodes), "material")
        self.config = config
        self.taught, self.held = hold_out(split.train, config.validation, config.seed)
        self.module = FieldModule(config.seed, dropout)
        self.steps_seen = []

    def parameter_groups(self, rate):
        return [{"params": list(self.module.parameters()), "lr": rate}]

    def loss(self, generator):
        squares = self._errors(draw_batch(self.sampler, self.taught, self.config, generator)).square().sum(dim=-1)
        return squares.mean() / LENGTH**2, math.sqrt(squares.mean().item())

    def validation_mm(self):
        if not len(self.held):
            return None
        batch = self.sampler.batch(self.held.draw(np.random.default_rng(0), 32))
        return float(self._errors(batch).norm(dim=-1).mean())

    def after_step(self, step):
        self.steps_seen.append(step)

    def _errors(self, batch):
        """Vectors from the truth to the answer [mm] (batch, queries, 3)."""
        question = batch.question
        moved = batch.truth["position"] - question.query_places
        activation, places, wanted = (
            torch.tensor(np.ascontiguousarray(array), dtype=torch.float32, device=device_of(self.module))
            for array in (question.activation, question.query_places, moved)
        )
        return self.module(activation, places) - wanted
