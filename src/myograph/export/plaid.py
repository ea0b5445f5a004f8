"""The cases of a muscle as a dataset of PLAID (Physics-Learning AI Datamodel), by its package `pyplaid`.

A sample for each case, stored as one CGNS file; a split for each design. The mesh of every sample is the reference body
[mm]; fields at its nodes are `displacement_x` ... [mm] and the stored ones, components apart (`cauchy_stress_xx` ...
[MPa]); globals are the five activations, `hand_load` [N], `elbow_angle` [rad] (left out where it is not known) and the
number of the case.
Source: plaid-lib.readthedocs.io; the CGNS standard (SIDS) for the order of elements' nodes.
"""

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError, MissingPackageError
from myograph.fields import AXES, FIELDS
from myograph.files import write_whole_folder
from myograph.mesh.vtk import to_vtk

_CGNS = {4: "TETRA_4", 8: "HEXA_8", 10: "TETRA_10", 20: "HEXA_20", 27: "HEXA_27"}
_VERTICAL_FIRST = (*range(12), *range(16, 20), *range(12, 16))
"""CGNS numbers the upright edges of a hexahedron before those of its top; VTK after."""
_ORDER = {20: _VERTICAL_FIRST, 27: (*_VERTICAL_FIRST, 24, 22, 21, 23, 20, 25, 26)}
INFOS = "infos.yaml"


def write_plaid(out: Path, cases: MuscleCases, numbers: Sequence[int]) -> int:
    """Write the dataset into a new folder, or in place of an older one; gives back the number of samples.

    Parameters
    ----------
    numbers
        The number that each case carries.

    Raises InputError for a body without elements and for a folder of something else; MissingPackageError without
    pyplaid.
    """
    assert len(numbers) == len(cases)
    plaid, storage = _packages()
    if not len(cases.body.cells):
        raise InputError(f"{cases.muscle}: expected a body of elements, which PLAID needs, got none")
    if out.exists() and not (out / INFOS).is_file():
        raise InputError(f"{out}: expected a new folder or a PLAID dataset, found something else; take another name")
    splits = {word: cases.named(word).tolist() for word in dict.fromkeys(cases.design)}
    production = {"type": "simulation", "physics": "muscle, hyperelastic", "simulator": _simulator(cases)}
    infos = plaid.Infos(owner="unknown", license="unknown", data_production=production)

    def write(folder: Path) -> None:
        storage.save_to_disk(
            folder, lambda case: _sample(plaid.Sample, cases, case, numbers), splits, infos, backend="cgns"
        )

    write_whole_folder(out, write)
    return len(cases)


def _packages() -> tuple[Any, Any]:
    """The package and its storage; it sets up the root logger on import, which is undone."""
    root = logging.getLogger()
    handlers, level = root.handlers[:], root.level
    try:
        import plaid
        from plaid import storage
    except ModuleNotFoundError:
        raise MissingPackageError("pyplaid", "plaid", "writing a PLAID dataset") from None
    finally:
        root.handlers[:], root.level = handlers, level
    return plaid, storage


def _simulator(cases: MuscleCases) -> str:
    return " ".join(["myograph", cases.attributes.get("simulator", "")]).strip()


def _sample(make: Any, cases: MuscleCases, case: int, numbers: Sequence[int]) -> Any:
    from CGNS.PAT import cgnslib

    body, sample, chosen = cases.body, make(), np.array([case])
    sample.init_base(3, 3)
    zone = sample.init_zone(np.array([[len(body.reference), len(body.cells), 0]]), zone=cases.muscle)
    sample.set_nodes(body.reference)
    cells = _cgns_cells(body.cells) + 1
    cgnslib.newElements(zone, "elements", _CGNS[cells.shape[1]], np.array([1, len(cells)]), cells.ravel())
    position = cases.values("position", chosen)[0]
    columns = dict(zip((f"displacement_{axis}" for axis in AXES), (position - body.reference).T, strict=True))
    for name in cases.fields:
        if name != "position":
            columns |= _columns(name, cases.values(name, chosen)[0])
    for name, values in columns.items():
        sample.add_field(name, np.ascontiguousarray(values, dtype="<f8"))
    told = dict(zip((f"activation_{name}" for name in MUSCLES), cases.activation[case], strict=True))
    told |= {"hand_load": cases.hand_load[case], "elbow_angle": cases.elbow_angle[case], "case": numbers[case]}
    for name, value in told.items():
        if np.isfinite(value):
            sample.add_global(name, np.array([float(value)]))
    return sample


def _cgns_cells(cells: np.ndarray) -> np.ndarray:
    nodes = cells.shape[1]
    return to_vtk(cells)[:, _ORDER.get(nodes, range(nodes))]


def _columns(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    components = FIELDS[name].components
    if not components:
        return {name: values}
    return {f"{name}_{word}": column for word, column in zip(components, values.T, strict=True)}
