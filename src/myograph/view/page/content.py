"""Everything that a page knows, as JSON and one blob of numbers; `web/src/data.ts` reads it."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from jaxtyping import Int

import myograph
from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.inference.model_file import ModelFile
from myograph.limb.motion.activation_file import Activations
from myograph.units import degrees
from myograph.view.page.body import PageBody, packed_angle, packed_body
from myograph.view.page.bones import hinge_of, packed_bones
from myograph.view.page.fields import FieldChoice, field_choices, network_choice
from myograph.view.page.network import PageNetwork, packed_network
from myograph.view.page.packing import Packer
from myograph.view.page.solving import SolveTime
from myograph.view.page.source import ArmModels, tendon
from myograph.view.page.surface import MOST_NODES, PageSurface, page_surface
from myograph.view.page.truth import TruthCase
from myograph.view.palette import muscle_colours

SCHEMA = 1
SINGLE_BYTES = 3 * 2**20
"""Modes beyond that many bytes are packed into half of them."""
UNTRAINED_LOAD, BEYOND = 20.0, 1.25
"""Where the load's slider ends [N]; times the largest trained load where there is one."""
MOST_TIMES = 5000
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
class PageArm:
    """What a page is made of; what beside the models is there where it is known.

    Parameters
    ----------
    models
        Neural modes of the muscles.
    truth
        Cases to compare with.
    movement, movement_name
        Activations over time.
    network
        Asked beside the modes of its muscle.
    solve
        How long a solver takes for a case, where the truth does not tell.
    """

    models: ArmModels
    truth: Sequence[TruthCase] = ()
    movement: Activations | None = None
    movement_name: str = ""
    network: PageNetwork | None = None
    solve: SolveTime | None = None

    @property
    def solve_time(self) -> SolveTime | None:
        """Of the truth, else of the cases that come with the package."""
        return next((case.solve for case in self.truth if case.solve is not None), self.solve)


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
    notes = _notes(asked, surfaces)
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
        "about": _about(asked),
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


def _notes(asked: PageArm, surfaces: Mapping[str, PageSurface]) -> list[str]:
    """What people should know of this page, a sentence each."""
    models, notes = asked.models, []
    for name, surface in surfaces.items():
        if surface.left_out:
            notes.append(
                f"{name}: {surface.on_skin} of {surface.on_skin + surface.left_out} nodes of the surface are drawn."
            )
    missing = [name for name in MUSCLES if name not in models.muscles]
    if missing:
        notes.append(f"No model of {', '.join(missing)}: not drawn.")
    if models.arm is None:
        notes.append("Made with another arm than the one at hand: no bones, no tendons. Give its file with --arm.")
    first = next(iter(models.muscles.values()))
    if first.angle.ends is None:
        notes.append("The model does not tell the elbow's angle: the forearm's bones are not drawn.")
    if first.trained_range.hand_load[0] == first.trained_range.hand_load[1]:
        notes.append(f"Trained with {first.trained_range.hand_load[0]:g} N in the hand only.")
    if asked.network is not None:
        notes.append(_network_note(asked.network))
    if asked.movement is not None:
        notes += [f"{asked.movement_name}: {note}." for note in asked.movement.notes]
        if len(asked.movement.times) > MOST_TIMES:
            notes.append(f"{asked.movement_name}: {MOST_TIMES} of {len(asked.movement.times)} rows are kept.")
    return notes


def _network_note(network: PageNetwork) -> str:
    told, nodes = network.model.told, network.model.body.nodes
    sensors = f"{len(network.sensors)} sensors, placed as the modes say" if len(network.sensors) else "activations"
    other = "" if nodes == len(network.muscle.reference) else f"; it was taught on a body of {nodes} nodes"
    return f"{told.name}: answers for the {told.muscle} from {sensors}{other}."


def _about(asked: PageArm) -> dict[str, str]:
    models, network = asked.models, asked.network
    told = next(iter(models.told.values()))
    rows = {
        "model": f"{told.name} ({', '.join(models.muscles)})",
        "nodes": ", ".join(str(len(muscle.reference)) for muscle in models.muscles.values()),
        "trained on": f"{told.origin.cases} cases by {told.origin.simulator or 'an unknown simulator'}",
        "preset": told.origin.preset,
        "arm": told.origin.arm_checksum[:12],
        "protocol": told.origin.protocol,
    }
    rows |= _errors(list(models.told.values()))
    if network is not None:
        its = network.model.told
        rows["network"] = f"{its.name} ({its.muscle}), {its.parameters} numbers"
        rows |= {f"network, {name}": value for name, value in _errors([its]).items()}
    solve = asked.solve_time
    if solve is not None:
        rows[solve.what] = f"{solve.seconds:.3g} s: {solve.told}"
    return {name: value for name, value in rows.items() if value} | {"made by": f"myograph {myograph.__version__}"}


def _errors(models: Sequence[ModelFile]) -> dict[str, str]:
    """Of each protocol, the mean and the largest error of the muscle that has the largest."""
    rows = {}
    for protocol in models[0].metrics:
        for figure in ("mean_mm", "max_mm"):
            known = [
                (told.metrics[protocol][figure], told.muscle)
                for told in models
                if figure in told.metrics.get(protocol, {})
            ]
            if known:
                value, muscle = max(known)
                rows[f"{protocol}, {figure.removesuffix('_mm')} error"] = f"{value:.3g} mm ({muscle})"
    return rows
