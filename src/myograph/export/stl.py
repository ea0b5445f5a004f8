"""Surfaces as a binary STL file: triangles in mm, with their normals; bodies one after the other.

STL knows neither units nor names: mm is what programs for printing take it for.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.export.gltf.frame import triangles_of
from myograph.export.target import write_place

HEADER = b"myograph: binary STL, mm"
HEADER_BYTES = 80
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
Surfaces = Mapping[str, tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "facets 4"]]]


def write_stl(path: Path, surfaces: Surfaces) -> int:
    """Write positions [mm] and quadrilaterals of each body; gives back the number of triangles.

    Raises InputError for bodies without any surface, and where the file cannot be written.
    """
    corners = [points[triangles_of(quads)] for points, quads in surfaces.values()]
    if not corners or not all(map(len, corners)):
        bare = [name for name, (_, quads) in surfaces.items() if not len(quads)]
        raise InputError(f"STL: expected bodies with a surface, got none of {', '.join(bare) or 'any'}")
    triangles = np.concatenate(corners)
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    records = np.zeros(len(triangles), dtype=_RECORD)
    records["corners"] = triangles
    records["normal"] = across / np.where(length > 0, length, 1.0)
    data = HEADER.ljust(HEADER_BYTES) + len(triangles).to_bytes(4, "little") + records.tobytes()
    write_place(path, HEADER, lambda place: place.write_bytes(data))
    return len(triangles)
