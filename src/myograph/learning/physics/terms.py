r"""Terms of a loss for what is known of a muscle without any case.

    volume    mean (det F - 1)²,  F = ∂T/∂X,  at random integration points
    clamped   mean |T(X) - T_0|²  at the nodes that stay at T_0 in all training cases

A network answers T of the place p at which it is asked, and of S, where that place is in the initial case. F is their
derivative, by differentiating backwards through the network, times that of these over X, which the elements give:

    F = ∂T/∂p ∂p/∂X + ∂T/∂S ∂S/∂X,    p = X ('material') or S ('initial')
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor

from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.question import Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.modes.volume import fixed_nodes
from myograph.learning.physics.config import Physics
from myograph.learning.physics.points import random_points
from myograph.mesh.kinds import element_of

PLACES, INITIAL = "query_places", "query_position_initial"

Parts = dict[str, Tensor]


@dataclass(frozen=True)
class Asking:
    """How a network is asked: parts of a question, and positions [mm] of them.

    Convention: what is answered at a query depends on that query alone, so that sums may be differentiated.
    """

    parts: Callable[[Question], Parts]
    positions: Callable[[Parts], Float[Tensor, "batch queries 3"]]


@dataclass(frozen=True)
class PhysicsTerms:
    """The terms, for the cases that teach.

    Parameters
    ----------
    clamped_nodes, clamped_at
        Nodes that stay in all training cases, and where they are [mm]; none where that is not minded.
    """

    config: Physics
    sampler: PairSampler
    clamped_nodes: Int[np.ndarray, " clamped"]
    clamped_at: Float[np.ndarray, "clamped 3"]

    def loss(
        self, asking: Asking, pairs: Int[np.ndarray, "batch 2"], generator: np.random.Generator
    ) -> Float[Tensor, ""]:
        """Sum of the terms by their weights, for these pairs of cases."""
        found = []
        if self.config.volume:
            first, second, third = self.gradients(asking, pairs, generator).float().unbind(dim=-2)
            ratios = (first * torch.linalg.cross(second, third)).sum(dim=-1)
            found.append(self.config.volume * (ratios - 1).square().mean())
        if self.config.clamped:
            found.append(self.config.clamped * self._off(asking, pairs, generator).square().sum(dim=-1).mean())
        return torch.stack(found).sum()

    def gradients(
        self, asking: Asking, pairs: Int[np.ndarray, "batch 2"], generator: np.random.Generator
    ) -> Float[Tensor, "batch points 3 3"]:
        """F of the answers at random points [-]."""
        cases = self.sampler.cases
        points = random_points(cases.body, generator, self.config.points)
        question = self.sampler.batch(pairs, np.arange(cases.nodes)).question
        at_nodes = question.query_initial["position"].astype(np.float64)
        before, material = points.carry(at_nodes), question.convention == "material"
        rest = np.broadcast_to(points.carry(cases.body.reference[None]), before.shape)
        asked = replace(
            question,
            query_nodes=points.nodes[:, 0],
            query_places=rest if material else before,
            query_initial={"position": before},
        )
        parts = asking.parts(asked)
        moved = torch.from_numpy(points.gradient(at_nodes)).to(parts[PLACES])
        over = {INITIAL: moved, PLACES: torch.eye(3).to(moved).expand_as(moved) if material else moved}
        return _total(asking.positions, parts, over)

    def _off(
        self, asking: Asking, pairs: Int[np.ndarray, "batch 2"], generator: np.random.Generator
    ) -> Float[Tensor, "batch points 3"]:
        """How far clamped nodes are answered from where they are [mm]."""
        count = min(self.config.points, len(self.clamped_nodes))
        rows = generator.choice(len(self.clamped_nodes), size=count, replace=False)
        answered = asking.positions(asking.parts(self.sampler.batch(pairs, self.clamped_nodes[rows]).question))
        return answered - torch.from_numpy(self.clamped_at[rows]).to(answered)


def physics_terms(config: Physics, sampler: PairSampler, pairs: PairSet) -> PhysicsTerms | None:
    """The terms, for the cases of these pairs; None where nothing is minded.

    Raises InputError for a body without known elements, and where no node stays where it is.
    """
    none = PhysicsTerms(config, sampler, np.zeros(0, dtype=np.int64), np.zeros((0, 3)))
    if config.volume:
        try:
            element_of(sampler.cases.body.cells)
        except InputError as problem:
            raise InputError(f"physics: volumes are those of elements: {problem}; set volume to 0") from None
    if not config.clamped:
        return none if config.minded else None
    positions = sampler.cases.values("position", pairs.cases)
    nodes = fixed_nodes(positions)
    if not len(nodes):
        raise InputError(
            "physics: expected nodes that stay where they are in all training cases, got none; set clamped to 0"
        )
    return replace(none, clamped_nodes=nodes, clamped_at=positions[:, nodes].mean(axis=0))


def _total(
    positions: Callable[[Parts], Tensor], parts: Parts, over: dict[str, Tensor]
) -> Float[Tensor, "batch points 3 3"]:
    """Derivative of positions over X, by that of what they are answered of."""
    free = {name: parts[name].detach().requires_grad_() for name in over if name in parts}
    answered = positions({**parts, **free})
    rows = [
        torch.autograd.grad(answered[..., axis].sum(), list(free.values()), create_graph=True, materialize_grads=True)
        for axis in range(3)
    ]
    by_part = zip(free, zip(*rows, strict=True), strict=True)
    return torch.stack([torch.stack(own, dim=-2) @ over[name] for name, own in by_part]).sum(dim=0)
