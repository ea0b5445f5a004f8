"""A muscle at some of its nodes: where its shapes are looked at to see what fewer modes cost."""

import itertools
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.inference.low_rank import LowRankField, LowRankMuscle

DRAWN = 480
"""Activations drawn at random, beside those at the corners of the trained range."""


def at_nodes(muscle: LowRankMuscle, nodes: Int[np.ndarray, " chosen"]) -> LowRankMuscle:
    """The same muscle at these nodes; elements are left out, and so are facets that lose a node."""
    number = np.full(len(muscle.reference), -1)
    number[nodes] = np.arange(len(nodes))
    skin = number[muscle.skin]
    fields = {
        name: replace(field, mean=field.mean[nodes], modes=field.modes[:, nodes], misfit=field.misfit[nodes])
        for name, field in muscle.fields.items()
    }
    return replace(
        muscle,
        fields=fields,
        reference=muscle.reference[nodes],
        skin=skin[(skin >= 0).all(axis=1)],
        cells=np.zeros((0, muscle.cells.shape[1]), dtype=np.int64),
    )


def on_surface(muscle: LowRankMuscle) -> LowRankMuscle:
    """The muscle at the nodes of its surface; raises InputError for a model without one."""
    if not len(muscle.skin):
        raise InputError(
            f"{muscle.name}: expected a model that knows the surface of its body, got one without; ask for all nodes"
        )
    return at_nodes(muscle, np.unique(muscle.skin))


def with_modes(field: LowRankField, count: int) -> LowRankField:
    """The field with its first modes only: those with the largest amounts."""
    return replace(field, modes=field.modes[:count], weights=field.weights[:, :count])


def asked_activations(muscle: LowRankMuscle) -> Float[np.ndarray, "asked inputs"]:
    """Activations and loads of the whole trained range: its corners, and many between, always the same."""
    trained = muscle.trained_range
    low = np.array([*trained.activation_low, trained.hand_load[0]])
    high = np.array([*trained.activation_high, trained.hand_load[1]])
    corners = np.array(list(itertools.product((0.0, 1.0), repeat=len(MUSCLES) + 1)))
    drawn = np.random.default_rng(0).uniform(size=(DRAWN, len(MUSCLES) + 1))
    return low + np.concatenate([np.unique(corners * (high > low), axis=0), drawn]) * (high - low)


def amounts_over(muscle: LowRankMuscle, name: str) -> Float[np.ndarray, "asked modes"]:
    """Amounts of a field's modes at all of these."""
    places = [muscle.place(asked[:-1], float(asked[-1])) for asked in asked_activations(muscle)]
    return np.stack([muscle.fields[name].amounts(place.x, place.u) for place in places])
