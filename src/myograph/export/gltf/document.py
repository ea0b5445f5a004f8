"""The file: a node, a mesh and a material for each body, an animation of weights and of the forearm's rotation.

Source: Khronos Group, glTF 2.0 specification; binary files: chapter 4.
"""

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from myograph import __version__
from myograph.export.gltf.buffers import Buffers
from myograph.export.gltf.frame import normals_of, placed, triangles_of, turned
from myograph.export.gltf.rigid import Rigid, Turning
from myograph.export.gltf.shaped import Shaped
from myograph.export.target import write_place

MAGIC = b"glTF"
VERSION = 2
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
ROUGHNESS = 0.6
Document = dict[str, Any]


@dataclass(frozen=True)
class Scene:
    """What the file shows.

    Parameters
    ----------
    muscles, bones
        The bodies.
    times
        Of the movement [s].
    turning
        Of the bones that move; None where no angle is known.
    centre
        A point on the hinge [mm]: the origin of the file.
    """

    muscles: Sequence[Shaped]
    bones: Sequence[Rigid]
    times: Float[np.ndarray, " times"]
    turning: Turning | None
    centre: Float[np.ndarray, " 3"]


def write_gltf(path: Path, scene: Scene) -> int:
    """Write the file; gives back its size in bytes. Raises InputError where it cannot be written."""
    data = gltf_bytes(scene)
    write_place(path, MAGIC, lambda place: place.write_bytes(data))
    return len(data)


def gltf_bytes(scene: Scene) -> bytes:
    """The bytes of a .glb file."""
    buffers = Buffers()
    document = _document(scene, buffers)
    text = json.dumps(document, separators=(",", ":")).encode()
    chunks = b"".join(
        struct.pack("<II", len(padded), kind) + padded
        for kind, padded in (
            (JSON_CHUNK, text + b" " * (-len(text) % 4)),
            (BINARY_CHUNK, bytes(buffers.data) + b"\0" * (-len(buffers.data) % 4)),
        )
    )
    return struct.pack("<4sII", MAGIC, VERSION, 12 + len(chunks)) + chunks


def _document(scene: Scene, buffers: Buffers) -> Document:
    nodes: list[Document] = []
    meshes: list[Document] = []
    materials: list[Document] = []
    times = buffers.floats(scene.times - scene.times[0], bounds=True)
    samplers: list[Document] = []
    channels: list[Document] = []

    def animate(values: int, path: str) -> None:
        channels.append({"sampler": len(samplers), "target": {"node": len(nodes), "path": path}})
        samplers.append({"input": times, "output": values, "interpolation": "LINEAR"})

    for muscle in scene.muscles:
        animate(buffers.floats(muscle.weights.ravel()), "weights")
        nodes.append({"name": muscle.name, "mesh": len(meshes)})
        meshes.append(_muscle_mesh(muscle, len(materials), buffers))
        materials.append(_material(muscle.name, muscle.colour))
    for bone in scene.bones:
        if bone.moves and scene.turning is not None:
            animate(buffers.floats(scene.turning.quaternions), "rotation")
        nodes.append({"name": bone.name, "mesh": len(meshes)})
        meshes.append(_bone_mesh(bone, scene.centre, len(materials), buffers))
        materials.append(_material(bone.name, bone.colour))
    return {
        "asset": {
            "version": "2.0",
            "generator": f"myograph {__version__}",
            "extras": {"origin_mm": scene.centre.tolist(), "source_frame": "mm, z up; here metres, Y up"},
        },
        "scene": 0,
        "scenes": [{"name": "arm", "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "animations": [{"name": "movement", "samplers": samplers, "channels": channels}],
        "accessors": buffers.accessors,
        "bufferViews": buffers.views,
        "buffers": [{"byteLength": len(buffers.data) + -len(buffers.data) % 4}],
    }


def _muscle_mesh(muscle: Shaped, material: int, buffers: Buffers) -> Document:
    primitive = _primitive(muscle.points, muscle.normals, muscle.triangles, material, buffers)
    primitive["targets"] = [
        {
            "POSITION": buffers.floats(target, vertices=True, bounds=True),
            "NORMAL": buffers.floats(normals, vertices=True),
        }
        for target, normals in zip(muscle.targets, muscle.target_normals, strict=True)
    ]
    names = [f"mode {number + 1}" for number in range(len(muscle.targets))]
    return {
        "name": muscle.name,
        "primitives": [primitive],
        "weights": muscle.weights[0].tolist(),
        "extras": {"targetNames": names},
    }


def _bone_mesh(bone: Rigid, centre: np.ndarray, material: int, buffers: Buffers) -> Document:
    triangles = triangles_of(bone.quads)
    normals = turned(normals_of(bone.points, triangles))
    primitive = _primitive(placed(bone.points, centre), normals, triangles, material, buffers)
    return {"name": bone.name, "primitives": [primitive]}


def _primitive(
    points: np.ndarray, normals: np.ndarray, triangles: np.ndarray, material: int, buffers: Buffers
) -> Document:
    attributes = {
        "POSITION": buffers.floats(points, vertices=True, bounds=True),
        "NORMAL": buffers.floats(normals, vertices=True),
    }
    return {"attributes": attributes, "indices": buffers.indices(triangles), "material": material}


def _material(name: str, colour: str) -> Document:
    shown = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in shown]
    metallic = {"baseColorFactor": [*linear, 1.0], "metallicFactor": 0.0, "roughnessFactor": ROUGHNESS}
    return {"name": name, "pbrMetallicRoughness": metallic}
