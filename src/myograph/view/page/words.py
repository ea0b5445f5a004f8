"""What a page says about itself: notes for those who look at it, and facts of its models."""

from collections.abc import Mapping, Sequence

import myograph
from myograph.case import MUSCLES
from myograph.inference.model_file import ModelFile
from myograph.view.page.asked import MOST_TIMES, PageArm
from myograph.view.page.network import PageNetwork
from myograph.view.page.surface import PageSurface


def page_notes(asked: PageArm, surfaces: Mapping[str, PageSurface]) -> list[str]:
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


def page_facts(asked: PageArm) -> dict[str, str]:
    """What the models are, whence they come, and how far they are off."""
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
