"""Import: files of another program become a store, whole or not at all."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from myograph.ensemble.card.writing import write_card
from myograph.ensemble.csv_rows import Row
from myograph.ensemble.design.cases import Design
from myograph.ensemble.importing.answers import bodies_checksum, body_of, fields_of
from myograph.ensemble.importing.frames import Frame, Frames
from myograph.ensemble.importing.mapping import Mapping as ImportMapping
from myograph.ensemble.importing.mapping import MuscleMapping, file_of, holds_all, read_mapping
from myograph.ensemble.importing.table import read_table
from myograph.ensemble.simulators import IMPORT
from myograph.ensemble.spec import Body, SimulatorSpec
from myograph.ensemble.store.making import make_store
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.summary import write_summary
from myograph.ensemble.store.writing import write_answer
from myograph.errors import InputError
from myograph.files import write_whole_folder

Progress = Callable[[int], None]


@dataclass(frozen=True)
class Source:
    """Where the data of a mapping lie."""

    folder: Path
    mapping: ImportMapping
    rows: list[Row]

    def frame(self, frames: Frames, muscle: MuscleMapping, case: int) -> Frame:
        """What the files say of a muscle in a case."""
        path = self.folder / file_of(muscle.files, case, self.rows[case])
        return frames.read(path, case if holds_all(muscle.files) else None)


def import_store(
    mapping_file: Path, out: Path, provenance: Mapping[str, str], progress: Progress = lambda _: None
) -> int:
    """Make a store of the data that the mapping describes; gives back the number of cases.

    Raises InputError for a mapping, a table or files that do not fit, and where `out` exists already; then nothing
    is written.
    """
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise InputError(f"{out}: expected a new folder, found something there; take another name")
    mapping = read_mapping(mapping_file)
    design, rows = read_table(mapping_file.parent / mapping.cases.file, mapping.cases)
    source = Source(mapping_file.parent, mapping, rows)
    bodies = {name: _body(source, muscle) for name, muscle in mapping.muscles.items()}
    plan = _plan(design, mapping, bodies)

    def fill(store: Path) -> None:
        make_store(store, plan, bodies, provenance)
        frames = {name: Frames() for name in bodies}
        for case in range(plan.size):
            fields = {}
            for name, muscle in mapping.muscles.items():
                frame = source.frame(frames[name], muscle, case)
                fields[name] = fields_of(frame, mapping, bodies[name].reference)
                _same_elements(frame, bodies[name])
            write_answer(store, plan, case, fields, design.cases[case].elbow_angle)
            progress(case + 1)
        write_summary(store, plan)
        write_card(store, out.resolve().name)

    write_whole_folder(out, fill)
    return plan.size


def _body(source: Source, muscle: MuscleMapping) -> Body:
    frames = Frames()
    if muscle.reference is not None:
        return body_of(frames.read(source.folder / muscle.reference), source.mapping)
    position = source.mapping.fields.position
    if not position.displacement and position.array == "points":
        raise InputError(
            f"{muscle.files}: the points move with the cases: expected 'reference', the file of the reference body"
        )
    return body_of(source.frame(frames, muscle, 0), source.mapping)


def _same_elements(frame: Frame, body: Body) -> None:
    if frame.cells is not None and len(body.cells) and not np.array_equal(frame.cells, body.cells):
        raise InputError(f"{frame.source}: expected the elements of the reference body, got others")


def _plan(design: Design, mapping: ImportMapping, bodies: Mapping[str, Body]) -> StorePlan:
    described = {"kind": IMPORT, "preset": mapping.name, "arm_checksum": bodies_checksum(bodies.values())}
    nodes = {name: len(body.reference) for name, body in bodies.items()}
    spec = SimulatorSpec(IMPORT, mapping.name, "")
    return StorePlan(design, spec, described, tuple(bodies), nodes, {}, mapping.fields.stored)
