"""One muscle as the page gets it: its surface, and its fields at the nodes of that."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

from myograph.inference.low_rank import AngleNetwork, LowRankField, LowRankMuscle
from myograph.inference.low_rank.field import RANGE
from myograph.view.page.packing import Packer
from myograph.view.page.surface import PageSurface

FACTORS = {"position": "position", "cauchy_stress": "von_mises"}
"""Field -> whose half width its deviation is scaled to."""


@dataclass(frozen=True)
class PageBody:
    """A muscle of a page; `tendon` is the share of tendon at each node of the body, None where it is not known."""

    muscle: LowRankMuscle
    surface: PageSurface
    colour: str
    tendon: Float[np.ndarray, " nodes"] | None


def packed_body(body: PageBody, packer: Packer, compact: bool) -> dict[str, Any]:
    """What the page is told of it; `compact` packs modes into half the bytes."""
    muscle, surface = body.muscle, body.surface
    nodes, between = surface.nodes, surface.between
    trained = muscle.trained_range
    rest = muscle.at(np.array(trained.activation_low), trained.hand_load[0])["position"]
    return {
        "name": muscle.muscle,
        "colour": body.colour,
        "own": muscle.own,
        "own_deviation": muscle.own_deviation,
        "nodes": packer.integers(nodes),
        "skin_nodes": surface.on_skin,
        "reference": packer.reals(muscle.reference[nodes]),
        "rest_change": packer.reals((rest - muscle.fields["position"].mean)[nodes]),
        "tendon": None if body.tendon is None else packer.reals(body.tendon[nodes]),
        "triangles": packer.integers(surface.triangles),
        "between": between and {"nodes": packer.integers(between.parents), "weights": packer.reals(between.weights)},
        "sensors": list(surface.sensors),
        "fields": {
            name: _packed_field(field, muscle.half_width_90.get(FACTORS.get(name, name)), nodes, (packer, compact))
            for name, field in muscle.fields.items()
        },
    }


def packed_angle(angle: AngleNetwork, most_x: float, packer: Packer) -> dict[str, Any]:
    """The networks from activations and load to the elbow's angle."""
    layers = ("first", "first_offset", "second", "second_offset", "last", "last_offset")
    members, _, width = angle.first.shape
    return {
        "centre": angle.centre.tolist(),
        "scale": angle.scale.tolist(),
        "members": members,
        "width": width,
        **{name: packer.doubles(getattr(angle, name)) for name in layers},
        "misfit": angle.misfit,
        "ends": angle.ends and list(angle.ends),
        "most_x": most_x,
        "range": RANGE,
    }


def _packed_field(
    field: LowRankField, factor: float | None, nodes: np.ndarray, packing: tuple[Packer, bool]
) -> dict[str, Any]:
    packer, compact = packing
    modes = field.modes[:, nodes]
    return {
        "components": field.components,
        "degrees": list(field.degrees),
        "mean": packer.reals(field.mean[nodes]),
        "modes": packer.compact(modes) if compact else packer.reals(modes),
        "weights": packer.doubles(field.weights),
        "misfit": packer.reals(field.misfit[nodes]),
        "factor": factor,
    }
