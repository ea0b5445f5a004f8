"""glTF: what the Khronos validator says, and what morph targets and rotations amount to."""

import json
import os
import shutil
import struct
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.export.gltf import Keys, Rigid, Scene, Turning, shaped_muscle, write_gltf
from myograph.export.gltf.frame import placed
from myograph.export.gltf.shaped import elbow_angles
from myograph.inference.low_rank import read_low_rank_arm
from myograph.view.surface import capsule
from tests.inference.low_rank.stand_in import save_arm

TARGETS = 4
VALIDATE = """
const validator = require('gltf-validator');
validator.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))
    .then(report => console.log(JSON.stringify(report)));
"""


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    return read_low_rank_arm(save_arm(tmp_path_factory.mktemp("arm"), ("biceps", "triceps")))


@pytest.fixture(scope="module")
def keys():
    activations = np.random.default_rng(2).uniform(size=(6, 5)) * 0.5
    return Keys(np.linspace(1.0, 2.5, 6), activations, 3.0)


@pytest.fixture(scope="module")
def scene(arm, keys):
    """Two muscles and two bones of the built-in arm."""
    anatomy = built_in_arm()
    hinge = anatomy.hinge.frame()
    angles = elbow_angles(list(arm.values()), keys)
    assert angles is not None
    bones = []
    for name in ("humerus", "radius"):
        bone = anatomy.bones[name]
        shape = capsule(np.array(bone.start), np.array(bone.end), bone.radius, name, "#e8d9b8")
        bones.append(Rigid(name, shape.colour, shape.points, shape.quads, bone.moves_with == "forearm"))
    muscles = [shaped_muscle(muscle, keys, TARGETS, hinge.point, "#d55e00") for muscle in arm.values()]
    return Scene(muscles, bones, keys.times, Turning(-hinge.axis, angles - anatomy.reference_angle), hinge.point)


@pytest.fixture(scope="module")
def written(scene, tmp_path_factory):
    path = tmp_path_factory.mktemp("gltf") / "arm.glb"
    assert write_gltf(path, scene) == path.stat().st_size
    return path


class Glb:
    """Arrays of a file by the number of their accessor."""

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.document = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]

    def array(self, number):
        accessor = self.document["accessors"][number]
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5123: "<u2"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        flat = np.frombuffer(self.binary, kind, accessor["count"] * width, view["byteOffset"])
        return flat.reshape(-1, width) if width > 1 else flat

    def animated(self, node, path):
        animation = self.document["animations"][0]
        named = [one["name"] for one in self.document["nodes"]]
        channel = next(
            one for one in animation["channels"] if one["target"] == {"node": named.index(node), "path": path}
        )
        return self.array(animation["samplers"][channel["sampler"]]["output"])


@pytest.fixture(scope="module")
def glb(written):
    return Glb(written)


def turned_by(quaternion, points):
    """Points turned by a unit quaternion x, y, z, w."""
    axis, real = quaternion[:3], quaternion[3]
    return points + 2 * np.cross(axis, np.cross(axis, points) + real * points)


def test_the_khronos_validator_finds_nothing(written):
    folder = os.environ.get("MYOGRAPH_GLTF_VALIDATOR", str(Path(__file__).parents[2] / "web" / "node_modules"))
    if shutil.which("node") is None or not (Path(folder) / "gltf-validator").is_dir():
        pytest.skip("no gltf-validator here: npm install gltf-validator, and MYOGRAPH_GLTF_VALIDATOR=.../node_modules")
    command = ["node", "-e", VALIDATE, str(written)]
    done = subprocess.run(command, env={**os.environ, "NODE_PATH": folder}, capture_output=True, text=True, check=True)
    issues = json.loads(done.stdout)["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_targets_and_weights_are_the_positions_of_the_model(glb, arm, keys, scene):
    for muscle, shaped in zip(arm.values(), scene.muscles, strict=True):
        mesh = next(one for one in glb.document["meshes"] if one["name"] == muscle.muscle)
        primitive = mesh["primitives"][0]
        targets = np.stack([glb.array(target["POSITION"]) for target in primitive["targets"]])
        weights = glb.animated(muscle.muscle, "weights").reshape(len(keys.times), TARGETS)
        assert np.abs(weights).max() == pytest.approx(1)
        nodes = np.unique(muscle.skin)
        for row, weight in zip(keys.activations, weights, strict=True):
            found = glb.array(primitive["attributes"]["POSITION"]) + np.tensordot(weight, targets, axes=1)
            wanted = placed(muscle.at(row, keys.hand_load)["position"][nodes], scene.centre)
            assert 1000 * np.linalg.norm(found - wanted, axis=1).max() <= shaped.error_mm + 1e-3
        assert mesh["weights"] == pytest.approx(weights[0])


def test_bones_of_the_forearm_turn_about_the_hinge(glb, arm, keys, scene):
    anatomy = built_in_arm()
    hinge = anatomy.hinge.frame()
    rotations = glb.animated("radius", "rotation")
    bone = scene.bones[1].points
    for row, rotation in zip(keys.activations, rotations, strict=True):
        angle = arm["biceps"].elbow_angle(row, keys.hand_load)
        wanted = placed(hinge.flex(bone, angle - anatomy.reference_angle), hinge.point)
        assert np.abs(turned_by(rotation.astype(float), placed(bone, hinge.point)) - wanted).max() < 1e-6
    moving = {channel["target"]["node"] for channel in glb.document["animations"][0]["channels"]}
    assert [node["name"] for number, node in enumerate(glb.document["nodes"]) if number not in moving] == ["humerus"]


def test_muscles_stand_upright_in_metres_with_normals_outwards(glb, arm):
    mesh = next(one for one in glb.document["meshes"] if one["name"] == "biceps")["primitives"][0]
    points, normals = (glb.array(mesh["attributes"][name]).astype(float) for name in ("POSITION", "NORMAL"))
    extent = np.ptp(points, axis=0)
    assert extent.argmax() == 1
    assert 0.1 < extent[1] < 0.6
    a, b, c = (points[glb.array(mesh["indices"]).reshape(-1, 3)[:, k]] for k in range(3))
    assert np.einsum("tx,tx->", a, np.cross(b, c)) > 0
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1, abs=1e-6)
    assert np.mean(np.einsum("nx,nx->n", normals, points - points.mean(axis=0)) > 0) > 0.9


def test_times_begin_at_zero(glb):
    times = glb.array(glb.document["animations"][0]["samplers"][0]["input"])
    assert (times[0], times[-1]) == (0, pytest.approx(1.5))


def test_no_targets_no_surface_and_other_files_are_refused(arm, keys, scene, tmp_path):
    with pytest.raises(InputError, match="expected at least 1, got 0"):
        shaped_muscle(arm["biceps"], keys, 0, scene.centre, "#ffffff")
    bare = replace(arm["biceps"], skin=arm["biceps"].skin[:0])
    with pytest.raises(InputError, match="knows the surface of its body, got one without"):
        shaped_muscle(bare, keys, 3, scene.centre, "#ffffff")
    (tmp_path / "arm.glb").write_text("my thesis")
    with pytest.raises(InputError, match="found something else"):
        write_gltf(tmp_path / "arm.glb", scene)
