"""Solved states of a muscle and the folder that keeps them: one file a state, written as soon as it is solved.

A file is whole or not there. One that cannot be read, or that was made from something else, counts as not there: the
state is solved anew.
"""

import hashlib
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.anatomy.load import muscle_checksum
from myograph.anatomy.model import Arm
from myograph.files import write_whole

FORMAT = 1
FIELDS_IN_TABLE: dict[str, tuple[int, ...]] = {
    "position": (3,),
    "cauchy_stress": (6,),
    "fibre_stretch": (),
    "pressure": (),
}
"""Node fields of a table and their components; the von Mises stress follows from the stress."""
NUMBERS = ("angle", "activation", "moment", "volume_change", "smallest_jacobian", "penetration", "seconds")


@dataclass(frozen=True)
class State:
    """One state, solved or failed.

    Parameters
    ----------
    angle, activation
        Elbow flexion [rad] and activation [-].
    failure
        Why it failed; empty where it was solved. All that follows has no meaning then.
    moment
        About the hinge [N*mm].
    newton_steps
        From the state before.
    volume_change, smallest_jacobian, penetration
        See `myograph.mechanics.soundness`.
    seconds
        What it took.
    fields
        Field name -> values at the nodes.
    vector
        All unknowns, to go on from.
    """

    angle: float
    activation: float
    failure: str
    moment: float = np.nan
    newton_steps: int = 0
    volume_change: float = np.nan
    smallest_jacobian: float = np.nan
    penetration: float = np.nan
    seconds: float = 0.0
    fields: Mapping[str, np.ndarray] = field(default_factory=dict)
    vector: Float[np.ndarray, " unknowns"] = field(default_factory=lambda: np.empty(0))


def state_key(arm: Arm, name: str, preset: str) -> str:
    """Checksum of everything a state depends on, its place apart."""
    text = json.dumps([FORMAT, version("myograph"), muscle_checksum(arm, name), name, preset])
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class StateStore:
    """Files of states of one muscle that were made from what `key` says."""

    folder: Path
    key: str

    def put(self, state: State) -> None:
        """Keep a solved state; raise InputError where the folder cannot be written."""
        arrays = {f"field_{name}": values for name, values in state.fields.items()}
        numbers = {name: np.array(getattr(state, name)) for name in NUMBERS}
        path = self._path(state.angle, state.activation)
        write_whole(
            path,
            lambda file: np.savez(
                file,
                allow_pickle=False,
                key=np.array(self.key),
                newton_steps=np.array(state.newton_steps),
                vector=state.vector,
                **numbers,
                **arrays,
            ),
        )

    def get(self, angle: float, activation: float, nodes: int) -> State | None:
        """The state of a muscle of so many nodes, if it is there, whole and of this key."""
        try:
            with np.load(self._path(angle, activation), allow_pickle=False) as data:
                arrays = {name: data[name] for name in data.files}
            numbers = {name: float(arrays[name]) for name in NUMBERS}
            fields = {name: arrays[f"field_{name}"] for name in FIELDS_IN_TABLE}
            state = State(
                failure="",
                newton_steps=int(arrays["newton_steps"]),
                fields=fields,
                vector=arrays["vector"],
                **numbers,
            )
        except (OSError, ValueError, KeyError, TypeError, EOFError, MemoryError, zipfile.BadZipFile):
            return None
        shapes = all(fields[name].shape == (nodes, *rest) for name, rest in FIELDS_IN_TABLE.items())
        values = (*numbers.values(), *fields.values(), state.vector)
        here = str(arrays["key"]) == self.key and abs(state.angle - angle) + abs(state.activation - activation) < 1e-8
        return state if here and shapes and all(np.isfinite(value).all() for value in values) else None

    def sweep(self) -> None:
        """Remove what an interrupted writer left behind."""
        for path in self.folder.glob(".*.npz-*"):
            path.unlink(missing_ok=True)

    def _path(self, angle: float, activation: float) -> Path:
        return self.folder / f"{angle:.9f}-{activation:.9f}.npz"
