"""`myograph export onnx`: the network of a saved model, checked, for any ONNX runtime."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from myograph.case import MUSCLES, check_muscle
from myograph.cli.arm_model import model_folder, read_models
from myograph.cli.options import Json, print_json
from myograph.errors import InputError, MissingPackageError
from myograph.export.target import write_place
from myograph.inference.at_rest import question_at_rest
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.model_file import MODEL_FILE, NETWORK, read_file
from myograph.inference.session import open_session

BEGINNING = b"\x08"
"""Of an ONNX file: the number of its first field, the version of the format."""
PARITY = 1e-5
MOVED_MM = 0.5
"""How much farther than the one before it each sensor is moved along every axis, for networks to differ by."""


def onnx(
    model: Annotated[
        str | None, typer.Argument(help="Folder of a saved model, or of one for each muscle; the shipped arm without.")
    ] = None,
    muscle: Annotated[str | None, typer.Option(help="Which muscle of the arm.")] = None,
    opset: Annotated[int | None, typer.Option(help="Operator set; as it was saved without it.")] = None,
    out: Annotated[Path, typer.Option(help="The file, .onnx.")] = Path("model.onnx"),
    json: Json = False,
) -> None:
    """Write the network of a saved model; everything is inside: mm, N and MPa in and out."""
    folder = _one_folder(model_folder(model), model, muscle)
    loaded = load(folder)
    if muscle is not None and loaded.told.muscle != check_muscle(muscle):
        raise InputError(f"{folder}: expected a model of {muscle}, got one of {loaded.told.muscle}; leave --muscle out")
    network = read_file(folder, NETWORK, loaded.told.files[NETWORK])
    if opset is not None and opset != loaded.told.opset:
        network = _converted(network, opset)
        _check_same(loaded, network)
    write_place(out, BEGINNING, lambda place: place.write_bytes(network))
    told = loaded.told.signature
    found = {"out": str(out), "bytes": len(network), "opset": opset or loaded.told.opset}
    if json:
        print_json({**found, "inputs": list(told.inputs), "outputs": list(told.outputs)})
        return
    typer.echo(
        f"{loaded.told.muscle}: opset {found['opset']}, {len(network) / 1e6:.2f} MB\n"
        f"  takes {', '.join(told.inputs)}\n  gives {', '.join(told.outputs)}\n  {out}"
    )


def _one_folder(folder: Path, model: str | None, muscle: str | None) -> Path:
    """The folder of one muscle's model."""
    if (folder / MODEL_FILE).is_file() or not folder.is_dir():
        return folder
    known = read_models(model, None, [muscle] if muscle else None).muscles
    if len(known) > 1:
        raise InputError(f"{folder}: expected --muscle, one of {', '.join(known)}, got none")
    wanted = next(iter(known))
    return next(
        path.parent for path in sorted(folder.glob(f"*/{MODEL_FILE}")) if load(path.parent).told.muscle == wanted
    )


def _converted(network: bytes, opset: int) -> bytes:
    try:
        from myograph.learning.opset import with_opset
    except ModuleNotFoundError:
        raise MissingPackageError("onnx", "train", "another operator set") from None
    return with_opset(network, opset)


def _check_same(loaded: LoadedModel, network: bytes) -> None:
    """Raise InputError where the converted network answers otherwise, of two states with its sensors moved apart."""
    other = LoadedModel(loaded.told, loaded.body, open_session(network, loaded.told.signature, 1, "converted"))
    asked = question_at_rest(loaded, np.linspace(0.1, 0.9, 2 * len(MUSCLES)).reshape(2, -1))
    moved = asked.sensor_target["position"] + MOVED_MM * np.arange(len(asked.sensor_nodes))[:, None]
    asked = replace(asked, sensor_target={**asked.sensor_target, "position": moved})
    wanted, found = (one.predict(asked).values for one in (loaded, other))
    for name, values in wanted.items():
        if not np.abs(found[name] - values).max() <= PARITY * np.abs(values).max():
            raise InputError(
                f"opset: expected the same '{name}' as before within {PARITY:g}, got another; take another"
            )
