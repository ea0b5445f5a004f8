"""A training between two steps as one file: nothing in it is ever unpickled.

    checkpoint.safetensors    tensors   module.NAME, average.NAME, best.NAME, optimiser.INDEX.NAME, course.COLUMN
                              metadata  'state': JSON with the configuration, what was trained, and the plain numbers

It takes the place of its predecessor whole or not at all. Chance needs no place in it: it follows from the seed and the
number of the step.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save
from torch import Tensor

from myograph.ensemble.store.lock import locked
from myograph.errors import InputError
from myograph.files import refusing, write_whole
from myograph.learning.training.history import COLUMNS
from myograph.learning.training.run import Run

FILE = "checkpoint.safetensors"
SCHEMA = 2
FREE = frozenset({"checkpoint_every", "log_every", "tensorboard", "histogram_every", "device", "compile"})
"""Settings that may change on the way: they change nothing that is computed, or only the last digits."""


@contextmanager
def held(folder: Path, run: Run, about: str) -> Iterator[None]:
    """Hold the folder, and go on with what it holds, or begin there: the first process does, all others follow it.

    Raises InputError, in all processes, for a folder of another training, or of something else, for a damaged
    checkpoint, and where another training is at work there.
    """
    with ExitStack() as stack:
        refused = _taken(folder, run, about, stack) if run.fabric.is_global_zero else None
        refused = run.fabric.broadcast(refused)
        if refused is not None:
            raise InputError(refused)
        if not run.fabric.is_global_zero:
            resume(folder / FILE, run, about)
        yield


def _taken(folder: Path, run: Run, about: str, stack: ExitStack) -> str | None:
    """Lock, sweep and open the folder; why it cannot be, if so. What is no training is left as it is."""
    try:
        if not (folder / FILE).is_file():
            _check_free(folder)
        with refusing(folder):
            folder.mkdir(parents=True, exist_ok=True)
        stack.enter_context(locked(folder, run.step))
        for lost in folder.glob(f".{FILE}-*"):
            lost.unlink(missing_ok=True)
        if (folder / FILE).is_file():
            resume(folder / FILE, run, about)
        else:
            write_checkpoint(folder, run, about)
    except InputError as problem:
        return str(problem)
    return None


def _check_free(folder: Path) -> None:
    if folder.exists() and (not folder.is_dir() or any(not found.name.startswith(".") for found in folder.iterdir())):
        raise InputError(f"{folder}: expected a training or nothing, got something else; choose another place")


def write_checkpoint(folder: Path, run: Run, about: str) -> None:
    """Store the training as it is now."""
    tensors = {name: value.detach().cpu().contiguous().clone() for name, value in _tensors(run).items()}
    state = {**_identity(run, about), "best": _numbers(run), "scaler": run.scaler_state()}
    state["sha256"] = _sha256(state, tensors)
    data = save(tensors, metadata={"state": json.dumps(state)})
    write_whole(folder / FILE, lambda file: file.write(data))


def resume(path: Path, run: Run, about: str) -> None:
    """Take the training of the file; raises InputError where that is another one, or damaged."""
    state, tensors = _read(path)
    _check_same(path, state, _identity(run, about))
    run.module.load_state_dict(_part(tensors, "module."))
    if run.average is not None:
        run.average.load(_part(tensors, "average."))
    _load_optimiser(run, _part(tensors, "optimiser."))
    run.course.fill({name: tensors[f"course.{name}"].numpy() for name in COLUMNS})
    run.best.error, run.best.mark, run.best.waited = (state["best"][name] for name in ("error", "mark", "waited"))
    run.best.weights = {name: value.to(run.fabric.device) for name, value in _part(tensors, "best.").items()}
    run.fabric.strategy.precision.load_state_dict(state["scaler"])
    run.continue_clock()


def _tensors(run: Run) -> dict[str, Tensor]:
    found = {f"module.{name}": value for name, value in run.module.state_dict().items()}
    found |= {f"best.{name}": value for name, value in run.best.weights.items()}
    if run.average is not None:
        found |= {f"average.{name}": value for name, value in run.average.values.items()}
    for index, moments in run.optimiser.state_dict()["state"].items():
        found |= {f"optimiser.{index}.{name}": value for name, value in moments.items()}
    return found | {f"course.{name}": torch.from_numpy(run.course.column(name)) for name in COLUMNS}


def _numbers(run: Run) -> dict[str, float]:
    return {"error": run.best.error, "mark": run.best.mark, "waited": run.best.waited}


def _identity(run: Run, about: str) -> dict[str, Any]:
    """What must be the same for going on, as JSON has it."""
    config = run.config.model_dump(mode="json", exclude=set(FREE))
    shapes = {name: list(value.shape) for name, value in run.module.state_dict().items()}
    return {"schema": SCHEMA, "about": about, **config, "weights": shapes}


def _check_same(path: Path, found: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    for name, value in wanted.items():
        if found.get(name) != value:
            was = "of other names or shapes" if name == "weights" else f"{found.get(name)}, now {value}"
            raise InputError(f"{path.parent}: holds another training: {name} was {was}; choose another folder")


def _load_optimiser(run: Run, tensors: Mapping[str, Tensor]) -> None:
    moments: dict[int, dict[str, Tensor]] = {}
    for key, value in tensors.items():
        index, _, name = key.partition(".")
        moments.setdefault(int(index), {})[name] = value
    groups = run.optimiser.state_dict()["param_groups"]
    run.optimiser.load_state_dict({"state": moments, "param_groups": groups})


def _read(path: Path) -> tuple[dict[str, Any], dict[str, Tensor]]:
    try:
        with safe_open(path, framework="pt") as file:
            state, names = json.loads(file.metadata()["state"]), file.keys()
            tensors = {name: file.get_tensor(name) for name in names}
        if state["schema"] != SCHEMA:
            raise ValueError(f"expected schema {SCHEMA}, got {state['schema']}: it is of another version")
        if state.pop("sha256") != _sha256(state, tensors):
            raise ValueError("altered bytes")
    except (OSError, SafetensorError, KeyError, TypeError, ValueError) as problem:
        raise InputError(
            f"{path}: not a checkpoint, or a damaged one ({problem}); remove the folder and train anew"
        ) from None
    return state, tensors


def _sha256(state: Mapping[str, Any], tensors: Mapping[str, Tensor]) -> str:
    digest = hashlib.sha256(json.dumps(state, sort_keys=True).encode())
    for name, values in sorted(tensors.items()):
        digest.update(f"{name} {values.dtype} {tuple(values.shape)} ".encode() + values.numpy().tobytes())
    return digest.hexdigest()


def _part(tensors: Mapping[str, Tensor], prefix: str) -> dict[str, Tensor]:
    return {name.removeprefix(prefix): value for name, value in tensors.items() if name.startswith(prefix)}
