"""The labelled dataset of one muscle: an `xarray.Dataset`, on disk as Zarr.

Dimensions and variables (units in the attributes, from `myograph.fields`):

    activation          (cases, muscles)        in the order of `myograph.MUSCLES`, which is the coordinate `muscles`
    elbow_angle         (cases,)                rad
    design              (cases,)                'factorial' or 'off_grid'
    reference_position  (nodes, axes)           material coordinates X, mm
    position            (cases, nodes, axes)    mm
    cauchy_stress       (cases, nodes, voigt)   MPa
    von_mises           (cases, nodes)          MPa
    fibre_stretch       (cases, nodes)
    pressure            (cases, nodes)          MPa
    surface_quads       (facets, corners)       node indices of the skin's quadrilaterals, outward normal

Attributes: `muscle`, `simulator`, `preset`, `myograph_version`, `arm_checksum`, `schema`.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from jaxtyping import Float, Int

from myograph.case import MUSCLES, Solution
from myograph.ensemble.node_fields import NODE_FIELDS
from myograph.errors import InputError
from myograph.fields import AXES, FIELDS, VOIGT
from myograph.files import write_whole_folder

SCHEMA = 1
_COMPONENT_DIMENSION = {AXES: ("axes",), VOIGT: ("voigt",), (): ()}


def dataset_from_solutions(
    solutions: Sequence[Solution],
    design: Sequence[str],
    muscle: str,
    body: tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "facets 4"]],
    attributes: Mapping[str, str],
) -> xr.Dataset:
    """Gather the fields of one muscle from many solutions.

    Parameters
    ----------
    design
        One word per solution: where its case came from ('factorial', 'off_grid').
    body
        Nodes in the reference body [mm], and the quadrilaterals of the skin.
    attributes
        Provenance: simulator, preset, arm_checksum, myograph_version.
    """
    reference_position, surface_quads = body
    data: dict[str, xr.Variable] = {
        "activation": _variable("activation", ("cases", "muscles"), np.array([s.case.activations for s in solutions])),
        "elbow_angle": _variable("elbow_angle", ("cases",), np.array([s.elbow_angle for s in solutions])),
        "design": xr.Variable(("cases",), np.array(design, dtype="<U16")),
        "reference_position": _variable("reference_position", ("nodes", "axes"), reference_position),
        "surface_quads": xr.Variable(("facets", "corners"), surface_quads),
    }
    for name in NODE_FIELDS:
        dimensions = ("cases", "nodes", *_COMPONENT_DIMENSION[FIELDS[name].components])
        data[name] = _variable(name, dimensions, np.stack([s.fields[muscle][name] for s in solutions]))
    coordinates = {"muscles": list(MUSCLES), "axes": list(AXES), "voigt": list(VOIGT)}
    return xr.Dataset(data, coords=coordinates, attrs={"muscle": muscle, "schema": SCHEMA, **attributes})


def _variable(name: str, dimensions: tuple[str, ...], values: np.ndarray) -> xr.Variable:
    return xr.Variable(dimensions, values, attrs={"units": FIELDS[name].unit, "long_name": FIELDS[name].meaning})


def save_dataset(dataset: xr.Dataset, path: Path) -> None:
    """Write the dataset as a Zarr folder, whole or not at all; raise InputError where it cannot be written."""
    stored = _texts_as(dataset, object)
    write_whole_folder(path, lambda aside: stored.to_zarr(aside, mode="w", consolidated=False))


def load_dataset(path: Path) -> xr.Dataset:
    """Read a dataset; raise InputError where there is none, or one of another schema."""
    if not path.is_dir():
        raise InputError(f"{path}: expected a dataset folder, found none")
    try:
        dataset = _texts_as(xr.open_zarr(path, consolidated=False).load(), str)
    except Exception as problem:
        raise InputError(f"{path}: not a readable dataset: {problem}") from None
    if dataset.attrs.get("schema") != SCHEMA:
        raise InputError(
            f"{path}: expected dataset schema {SCHEMA}, got {dataset.attrs.get('schema')!r}; simulate anew"
        )
    return dataset


def _texts_as(dataset: xr.Dataset, kind: type) -> xr.Dataset:
    """Texts of another kind: Zarr knows them as objects of any length, numpy in memory as arrays of equal length."""
    texts = [name for name, array in dataset.variables.items() if array.dtype.kind in "UOT"]
    changed = {name: np.array(dataset[name].values.tolist(), dtype=kind) for name in texts}
    return dataset.assign({str(name): (dataset[name].dims, values) for name, values in changed.items()})
