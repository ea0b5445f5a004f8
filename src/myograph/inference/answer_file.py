"""What a model answered at all nodes, as a file: arrays (.npz) or a row for each node of each case (.csv)."""

import csv
import io
from pathlib import Path

import numpy as np

from myograph.ensemble.pairs.question import Answer
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.files import write_whole
from myograph.inference.body_file import ModelBody

KINDS = (".csv", ".npz", ".vtkhdf")


def check_kind(path: Path, kinds: tuple[str, ...] = KINDS) -> None:
    """Raise InputError for another kind of file than these."""
    if path.suffix not in kinds:
        raise InputError(f"{path}: expected a file name that ends in {', '.join(kinds)}, got '{path.suffix}'")


def write_answer(path: Path, answer: Answer, body: ModelBody) -> None:
    """Write the file, whole or not at all.

    Arrays: reference_position (nodes, 3); FIELD, FIELD_deviation, FIELD_half_width_90 (cases, nodes, ...);
    inside (cases). Columns: case, node, then such as position_x_mm, von_mises_mpa, position_half_width_90_mm; at last
    inside, 1 or 0, the same for all nodes of a case. The verdict is there where the model gives one.
    """
    check_kind(path, (".csv", ".npz"))
    arrays = arrays_of(answer)
    if path.suffix == ".npz":
        kept = {"reference_position": body.body.reference, **arrays}
        if answer.inside is not None:
            kept["inside"] = answer.inside
        write_whole(path, lambda file: np.savez_compressed(file, allow_pickle=False, **kept))
        return
    text = _table(arrays, answer.inside).encode()
    write_whole(path, lambda file: file.write(text))


def arrays_of(answer: Answer) -> dict[str, np.ndarray]:
    """FIELD, FIELD_deviation, FIELD_half_width_90 (cases, nodes, ...)."""
    return {
        **answer.values,
        **{f"{name}_deviation": values for name, values in answer.deviation.items()},
        **{f"{name}_half_width_90": values for name, values in answer.half_width_90.items()},
    }


def _table(arrays: dict[str, np.ndarray], inside: np.ndarray | None) -> str:
    cases, nodes = next(iter(arrays.values())).shape[:2]
    columns = [np.repeat(np.arange(cases), nodes), np.tile(np.arange(nodes), cases)]
    names = ["case", "node"]
    for name, values in arrays.items():
        unit = FIELDS[name.removesuffix("_deviation").removesuffix("_half_width_90")].unit
        ending = "" if unit == "1" else f"_{unit.lower()}"
        parts = [f"_{part}" for part in FIELDS[name].components] if values.ndim == 3 else [""]
        names += [f"{name}{part}{ending}" for part in parts]
        columns += list(np.moveaxis(values.reshape(cases * nodes, len(parts)), 1, 0))
    if inside is not None:
        names.append("inside")
        columns.append(np.repeat(inside.astype(int), nodes))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for case, node, *numbers in zip(*(column.tolist() for column in columns), strict=True):
        writer.writerow([case, node, *(f"{number:.7g}" for number in numbers)])
    return text.getvalue()
