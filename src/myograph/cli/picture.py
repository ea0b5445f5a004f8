"""`myograph picture`: the arm in three dimensions, in one state or many."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from myograph.anatomy.load import arm_checksum
from myograph.case import MUSCLES
from myograph.cli.arm_model import Load, ModelOrDataset, activation_row, is_dataset, read_models
from myograph.cli.options import ArmFile, Json, print_json, read_arm
from myograph.cli.solids import Bones, Camera, Shown, Size, bone_solids, model_solid, size_of, solid_of, title_of
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.export.target import check_place, write_place
from myograph.view.picture import Panel, Solid, Stage, named_camera, png_bytes
from myograph.view.picture.solid import colours_of
from myograph.view.picture.stage import Setting

PNG = b"\x89PNG"
MOST_COLUMNS = 5


@dataclass(frozen=True)
class _State:
    """A title, the muscles, and the bones."""

    title: str
    muscles: list[Solid]
    bones: list[Solid]


def picture(
    model: ModelOrDataset = None,
    activation: Annotated[
        list[str] | None,
        typer.Option(help="Such as biceps=0.5, or five numbers; repeated for states side by side. Rest without."),
    ] = None,
    case: Annotated[list[int] | None, typer.Option(help="Of a dataset: which case; may be repeated.")] = None,
    muscle: Annotated[list[str] | None, typer.Option(help="Only these muscles; may be repeated.")] = None,
    each: Annotated[bool, typer.Option("--each", help="A panel for each muscle.")] = False,
    field: Shown = "muscle",
    camera: Camera = "oblique",
    load: Load = 0.0,
    bones: Bones = True,
    size: Size = "800x800",
    arm_file: ArmFile = None,
    out: Annotated[Path, typer.Option(help="The picture, PNG.")] = Path("picture.png"),
    json: Json = False,
) -> None:
    """Draw muscles and bones in three dimensions; many states or muscles make a contact sheet."""
    check_place(out, PNG)
    viewer = named_camera(camera)
    if is_dataset(model):
        if activation:
            raise InputError(f"{model}: expected --case of a dataset, got --activation")
        states = _dataset_states(Path(str(model)), case or [0], muscle, field, arm_file)
    elif case:
        raise InputError("expected --activation of a model, got --case")
    else:
        states = _model_states(model, activation or [None], muscle, (field, load), arm_file)
    panels = _panels(states, each, bones)
    columns = len(states[0].muscles) if each else min(len(panels), MOST_COLUMNS)
    setting = Setting(viewer, size_of(size), columns)
    colours = None if field == "muscle" else colours_of(title_of(field), panels)
    stage = Stage(panels, setting, colours)
    try:
        data = png_bytes(stage.image(panels))
    finally:
        stage.close()
    write_place(out, PNG, lambda place: place.write_bytes(data))
    if json:
        limits = (
            None if colours is None else {"title": colours.title, "least": colours.least, "largest": colours.largest}
        )
        print_json({"out": str(out), "panels": [panel.title for panel in panels], "colours": limits})
    else:
        typer.echo(str(out))


def _model_states(
    model: str | None, texts: Sequence[str | None], chosen: list[str] | None, shown: tuple[str, float], arm: Path | None
) -> list[_State]:
    models = read_models(model, arm, chosen)
    field, load = shown
    states = []
    for text in texts:
        row = activation_row(text)
        muscles = [model_solid(one, row, load, field) for one in models.muscles.values()]
        first = next(iter(models.muscles.values()))
        outside = "" if all(one.inside(row, load) for one in models.muscles.values()) else "\nOUTSIDE the training"
        angle = first.elbow_angle(row, load)
        states.append(_State(_title(row, angle) + outside, muscles, bone_solids(models.arm, angle)))
    return states


def _dataset_states(
    store: Path, numbers: list[int], chosen: list[str] | None, field: str, arm_file: Path | None
) -> list[_State]:
    """Cases by their place among those that have an answer."""
    arm = read_arm(arm_file)
    cases = {name: read_muscle(store, name) for name in chosen or read_plan(store).muscles}
    states = []
    for number in numbers:
        muscles = []
        for name, one in cases.items():
            wanted = {"position", *({field} & set(one.fields))}
            fields = {key: one.values(key, np.array([number]))[0] for key in wanted}
            if field == "displacement":
                rest = one.values("position", one.activation.sum(axis=1).argmin(keepdims=True))[0]
                fields[field] = np.linalg.norm(fields["position"] - rest, axis=1)
            muscles.append(solid_of(name, fields, one.body.skin, field))
        first = next(iter(cases.values()))
        angle = float(first.elbow_angle[number])
        same = first.attributes.get("arm_checksum", "") == arm_checksum(arm)
        title = f"case {number}: {_title(first.activation[number], angle)}"
        states.append(_State(title, muscles, bone_solids(arm if same else None, angle)))
    return states


def _panels(states: list[_State], each: bool, bones: bool) -> list[Panel]:
    if not each:
        return [Panel(state.title, [*(state.bones if bones else []), *state.muscles]) for state in states]
    return [Panel(f"{one.name}\n{state.title}", [one]) for state in states for one in state.muscles]


def _title(row: np.ndarray, angle: float | None) -> str:
    active = [f"{name} {value:.2g}" for name, value in zip(MUSCLES, row.tolist(), strict=True) if value > 0]
    elbow = "" if angle is None or not np.isfinite(angle) else f", elbow {np.degrees(angle):.0f}°"
    return (", ".join(active) or "at rest") + elbow
