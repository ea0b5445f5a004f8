"""Everything that a page knows, as JSON and one blob of numbers; `web/src/data.ts` reads it."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from jaxtyping import Int

from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.units import degrees
from myograph.view.page.asked import MOST_TIMES, PageArm
from myograph.view.page.body import PageBody, packed_angle, packed_body
from myograph.view.page.bones import hinge_of, packed_bones
from myograph.view.page.fields import FieldChoice, field_choices, network_choice
from myograph.view.page.network import packed_network
from myograph.view.page.packing import Packer
from myograph.view.page.source import ArmModels, tendon
from myograph.view.page.surface import MOST_NODES, PageSurface, page_surface
from myograph.view.page.truth import TruthCase
from myograph.view.page.words import page_facts, page_notes
from myograph.view.palette import muscle_colours

SCHEMA = 1
SINGLE_BYTES = 3 * 2**20
"""Modes beyond that many bytes are packed into half of them."""
UNTRAINED_LOAD, BEYOND = 20.0, 1.25
"""Where the load's slider ends [N]; times the largest trained load where there is one."""
FLESH = 0.02
"""Share of tendon below which a node is flesh, and no part of the blend into tendon."""
PRESETS: tuple[tuple[str, tuple[float, ...]], ...] = (
    ("relaxed", (0, 0, 0, 0, 0)),
    ("flexed", (0.6, 0.7, 0.8, 0, 0)),
    ("extended", (0, 0, 0, 0.6, 0.8)),
    ("stiff", (0.6, 0.6, 0.6, 0.6, 0.6)),
    ("biceps alone", (0, 0, 1, 0, 0)),
)


@dataclass(frozen=True)
class PageContent:
    """What is put into the page, and what people should know of it; `network` where one is asked in it."""

    data: str
    numbers: str
    title: str
    vertices: int
    fields: tuple[str, ...]
    notes: tuple[str, ...]
    network: str | None = None


def page_content(asked: PageArm, most_nodes: int = MOST_NODES) -> PageContent:
    """JSON and numbers; raises InputError for a body without a skin."""
    models = asked.models
    surfaces = {name: _surface(models, name, most_nodes) for name in models.muscles}
    packer = Packer()
    muscles = list(models.muscles.values())
    compact = sum(_mode_bytes(models, name, surface) for name, surface in surfaces.items()) > SINGLE_BYTES
    colours = muscle_colours(MUSCLES)
    bodies = [PageBody(m, surfaces[m.muscle], colours[m.muscle], tendon(models, m.muscle)) for m in muscles]
    trained = muscles[0].trained_range
    choices = _choices(asked, bodies)
    notes = page_notes(asked, surfaces)
    data = {
        "schema": SCHEMA,
        "title": models.arm.name if models.arm else models.name,
        "muscles": list(MUSCLES),
        "colours": [colours[name] for name in MUSCLES],
        "bodies": [packed_body(body, packer, compact) for body in bodies],
        "bones": packed_bones(models.arm, packer) if models.arm else [],
        "hinge": hinge_of(models.arm) if models.arm else None,
        "angle": packed_angle(muscles[0].angle, muscles[0].most_x, packer),
        "trained": {
            "low": list(trained.activation_low),
            "high": list(trained.activation_high),
            "load": list(trained.hand_load),
        },
        "most_load": BEYOND * trained.hand_load[1] if trained.hand_load[1] > 0 else UNTRAINED_LOAD,
        "fields": [asdict(choice) for choice in choices],
        "presets": [{"name": name, "activation": list(values), "hand_load": 0.0} for name, values in PRESETS],
        "truth": [_packed_truth(case, bodies, packer) for case in asked.truth],
        "movement": _packed_movement(asked, packer),
        "network": _packed_network(asked, bodies, packer),
        "solve": None if asked.solve_time is None else asdict(asked.solve_time),
        "about": page_facts(asked),
        "notes": notes,
    }
    text = json.dumps(data, allow_nan=False).replace("</", "<\\/")
    vertices = sum(_vertices(surface) for surface in surfaces.values())
    keys = tuple(choice.key for choice in choices)
    network = asked.network and asked.network.model.name
    return PageContent(text, packer.text(), data["title"], vertices, keys, tuple(notes), network)


def _surface(models: ArmModels, name: str, most: int) -> PageSurface:
    muscle = models.muscles[name]
    try:
        return page_surface(muscle.reference, muscle.skin, models.told[name].signature.sensors, most)
    except InputError as problem:
        raise InputError(f"model of {name}: {problem}") from None


def _choices(asked: PageArm, bodies: Sequence[PageBody]) -> list[FieldChoice]:
    bellies = [_belly(body) for body in bodies]
    found = field_choices([body.muscle for body in bodies], bellies, asked.truth)
    if asked.network is None:
        return found
    of = [body.muscle.muscle for body in bodies].index(asked.network.muscle.muscle)
    return [*found, network_choice(asked.network, bellies[of])]


def _packed_network(asked: PageArm, bodies: Sequence[PageBody], packer: Packer) -> dict[str, Any] | None:
    if asked.network is None:
        return None
    of = [body.muscle.muscle for body in bodies].index(asked.network.muscle.muscle)
    return {"body": of, **packed_network(asked.network, bodies[of].surface.nodes, packer)}


def _belly(body: PageBody) -> Int[np.ndarray, " nodes"]:
    """Nodes of the skin that are flesh and no tendon; all of them where that is not known."""
    skin = body.surface.nodes[: body.surface.on_skin]
    flesh = skin if body.tendon is None else skin[body.tendon[skin] < FLESH]
    return flesh if len(flesh) else skin


def _mode_bytes(models: ArmModels, name: str, surface: PageSurface) -> int:
    numbers = sum(len(field.modes) * field.components for field in models.muscles[name].fields.values())
    return 4 * numbers * len(surface.nodes)


def _vertices(surface: PageSurface) -> int:
    return surface.on_skin + (0 if surface.between is None else len(surface.between.parents))


def _packed_truth(case: TruthCase, bodies: Sequence[PageBody], packer: Packer) -> dict[str, Any]:
    packed: list[dict[str, Any] | None] = []
    for body in bodies:
        name, nodes = body.muscle.muscle, body.surface.nodes
        if name not in case.positions:
            packed.append(None)
            continue
        stress = case.stresses.get(name)
        position = packer.reals(case.positions[name][nodes])
        packed.append({"position": position, "von_mises": None if stress is None else packer.reals(stress[nodes])})
    return {
        "name": case.name,
        "activation": case.activation.tolist(),
        "hand_load": case.hand_load,
        "elbow_angle_deg": None if case.elbow_angle is None else degrees(case.elbow_angle),
        "bodies": packed,
    }


def _packed_movement(asked: PageArm, packer: Packer) -> dict[str, Any] | None:
    movement = asked.movement
    if movement is None:
        return None
    times, values = movement.times, movement.values
    if len(times) > MOST_TIMES:
        times = np.linspace(times[0], times[-1], MOST_TIMES)
        values = np.stack([np.interp(times, movement.times, column) for column in movement.values.T], axis=1)
    return {"name": asked.movement_name, "times": times.tolist(), "activation": packer.reals(values)}
