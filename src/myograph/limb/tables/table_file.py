"""Tables on disk: one `.npz` file of plain arrays each, whole or not there, checked before it is believed."""

import json
import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from myograph.errors import InputError
from myograph.files import write_whole
from myograph.interpolation import Domain, Modes, SparseGrid
from myograph.limb.tables.held_out import HeldOut
from myograph.limb.tables.provenance import FORMAT
from myograph.limb.tables.spec import spec_from
from myograph.limb.tables.state import FIELDS_IN_TABLE
from myograph.limb.tables.table import MuscleTable, Record

_WORDS = ("muscle", "preset", "key")
_RECORD = ("newton_steps", "volume_change", "smallest_jacobian", "penetration", "seconds", "failures")
_HELD_OUT = ("points", "mean_mm", "max_mm", "moment_nm", "failures")
_MODES = ("mean", "vectors", "coefficients", "largest_error")
_Arrays = Mapping[str, np.ndarray]


def table_path(folder: Path, name: str) -> Path:
    """Where the table of a muscle lies in a folder of tables."""
    return folder / f"{name}.npz"


def save_table(table: MuscleTable, path: Path) -> None:
    """Write the table; the file appears whole or not at all."""
    arrays = {
        "format": np.array(FORMAT),
        **{name: np.array(getattr(table, name)) for name in _WORDS},
        "spec": np.array(json.dumps(table.spec.as_dict())),
        "provenance": np.array(json.dumps(dict(table.provenance))),
        "lower": table.domain.lower,
        "upper": table.domain.upper,
        "levels": table.grid.levels,
        "indices": table.grid.indices,
        "moments": table.moments,
        "reference": table.reference,
        "skin": table.skin,
        **{f"record_{name}": getattr(table.record, name) for name in _RECORD},
        **{f"held_out_{name}": getattr(table.held_out, name) for name in _HELD_OUT},
    }
    for field, modes in table.modes.items():
        arrays |= {f"{field}_{name}": np.array(getattr(modes, name)) for name in _MODES}
    write_whole(path, lambda file: np.savez(file, allow_pickle=False, **arrays))


def load_table(path: Path, key: str | None = None) -> MuscleTable:
    """Read a table; raise InputError where it is missing, damaged, or not made from exactly what `key` says."""
    try:
        with np.load(path, allow_pickle=False) as data:
            found = int(data["format"]) if "format" in data.files else None
            if found != FORMAT:
                raise InputError(f"expected format {FORMAT}, got {found}")
            arrays = {name: data[name] for name in data.files}
        table = _table(arrays)
        _check(table, arrays)
    except (OSError, ValueError, KeyError, TypeError, EOFError, MemoryError, AttributeError) as problem:
        raise _refusal(path, problem) from None
    except (zipfile.BadZipFile, InputError) as problem:
        raise _refusal(path, problem) from None
    if key is not None and table.key != key:
        raise InputError(f"{path}: made for another arm, preset, spec or version; delete it and build the table anew")
    return table


def _refusal(path: Path, problem: Exception) -> InputError:
    return InputError(f"{path}: not a readable muscle table ({problem}); delete it and build the table anew")


def _table(arrays: _Arrays) -> MuscleTable:
    return MuscleTable(
        muscle=str(arrays["muscle"]),
        preset=str(arrays["preset"]),
        spec=spec_from(json.loads(str(arrays["spec"]))),
        key=str(arrays["key"]),
        domain=Domain(arrays["lower"], arrays["upper"]),
        grid=SparseGrid(arrays["levels"], arrays["indices"]),
        moments=arrays["moments"],
        modes={field: _modes(arrays, field) for field in FIELDS_IN_TABLE},
        reference=arrays["reference"],
        skin=arrays["skin"],
        record=Record(**{name: arrays[f"record_{name}"] for name in _RECORD}),
        held_out=HeldOut(**{name: arrays[f"held_out_{name}"] for name in _HELD_OUT}),
        provenance={str(name): str(value) for name, value in json.loads(str(arrays["provenance"])).items()},
    )


def _modes(arrays: _Arrays, field: str) -> Modes:
    mean, vectors, coefficients = (arrays[f"{field}_{name}"] for name in _MODES[:3])
    return Modes(mean, vectors, coefficients, float(arrays[f"{field}_largest_error"])).rounded()


def _check(table: MuscleTable, arrays: _Arrays) -> None:
    """Raise InputError unless all sizes fit each other and every number is one, failed states apart."""
    points, nodes, held_out = len(table.grid), len(table.reference), len(table.held_out.points)
    shapes: dict[str, tuple[int, ...]] = {
        "levels": (points, 2),
        "reference": (nodes, 3),
        "skin": (len(table.skin), 4),
        "moments": (points,),
        "held_out_points": (held_out, 2),
        **{f"record_{name}": (points,) for name in _RECORD},
        **{f"held_out_{name}": (held_out,) for name in _HELD_OUT[1:]},
    }
    for field, rest in FIELDS_IN_TABLE.items():
        width, number = nodes * int(np.prod(rest, dtype=int)), len(table.modes[field].vectors)
        shapes |= {f"{field}_mean": (width,), f"{field}_vectors": (number, width)}
        shapes |= {f"{field}_coefficients": (points, number)}
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise InputError(f"{name}: expected the shape {shape}, got {arrays[name].shape}")
    solved = table.record.failures == ""
    whole = [table.reference, table.moments[solved]]
    for modes in table.modes.values():
        whole += [modes.mean, modes.vectors, modes.coefficients[solved]]
    if not all(np.isfinite(values).all() for values in whole):
        raise InputError("expected numbers, got some that are not")
    if table.skin.size and not (table.skin.min() >= 0 and table.skin.max() < nodes):
        raise InputError(f"skin: expected nodes from 0 to {nodes - 1}")
