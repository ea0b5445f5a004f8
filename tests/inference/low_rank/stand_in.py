"""Saved neural modes of the built-in arm's muscles: small meshes, numbers drawn at random, no network in ONNX."""

import numpy as np
import safetensors.torch
import torch

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.ensemble.spec import Body
from myograph.fields import FIELDS
from myograph.inference.body_file import ModelBody, body_bytes
from myograph.inference.model_file import BODY, CARD, NETWORK, WEIGHTS
from myograph.inference.signature import Signature
from myograph.inference.writing import write_model
from myograph.learning.modes.config import BuiltModes, FieldShape, ModesConfig
from myograph.learning.modes.module import ModesModule
from myograph.mesh.presets import preset_mesh
from tests.inference.stand_in import told

SIZES = {"position": 40.0, "cauchy_stress": 0.05, "fibre_stretch": 0.1}  # mm, MPa, 1
NETWORK_SEED = 11
ENDS = (0.5, 2.0)  # rad


def body_of(muscle):
    """The muscle in the arm's reference pose, 153 nodes."""
    mesh = preset_mesh(built_in_arm(), muscle, "tiny")
    return Body(mesh.points, mesh.skin, mesh.cells)


def module_of(muscle, body, reads="activation", network=NETWORK_SEED):
    """Smooth modes, with amounts of a few of the field's own sizes; networks by that seed."""
    shapes = tuple(
        FieldShape(name=name, components=len(FIELDS[name].components) or 1, modes=5, degrees=(4, 3)) for name in SIZES
    )
    settings = ModesConfig(reads=reads, width=4, members=2, modes=5)
    module = ModesModule(
        BuiltModes(settings=settings, own=MUSCLES.index(muscle), nodes=len(body.reference), fields=shapes)
    )
    generator = np.random.default_rng(MUSCLES.index(muscle))
    scaled = (body.reference - body.reference.mean(axis=0)) / np.ptp(body.reference, axis=0).max()
    powers = np.concatenate([np.ones((len(scaled), 1)), scaled, scaled**2], axis=1)
    for shape in shapes:
        field, size = module.fields[shape.name], SIZES[shape.name]
        modes = np.einsum("np,pcm->ncm", powers, generator.normal(size=(7, shape.components, 5)))
        modes, _ = np.linalg.qr(modes.reshape(-1, 5))
        mean = body.reference if shape.name == "position" else np.full((len(scaled), shape.components), size)
        decay = (1 / (1 + np.arange(5))) ** 2 * 0.5 ** np.add.outer(np.arange(5), np.arange(4)).ravel()[:, None]
        field.mean.copy_(torch.tensor(mean))
        field.modes.copy_(torch.tensor(modes.reshape(len(scaled), shape.components, 5)))
        field.weights.copy_(torch.tensor(size * decay * generator.normal(size=(20, 5))))
        field.misfit.copy_(torch.tensor(size / 100 * generator.uniform(size=len(scaled))))
    if module.angle is not None:
        torch.manual_seed(network)
        with torch.no_grad():
            for parameter in module.angle.parameters():
                parameter.normal_(std=0.5)
        module.angle.centre.copy_(torch.tensor([0.5] * 5 + [10.0]))
        module.angle.scale.copy_(torch.tensor([0.5] * 5 + [10.0]))
    module.angle_misfit.fill_(0.01)
    module.angle_range.copy_(torch.tensor(ENDS))
    return module


def save_modes(folder, muscle="biceps", *, module=None, body=None, **other):
    """A saved model; what model.json says differently goes by name."""
    body = body or body_of(muscle)
    module = module or module_of(muscle, body)
    state = {name: tensor.contiguous().clone() for name, tensor in module.state_dict().items()}
    signature = Signature(inputs=module.inputs, outputs=module.outputs)
    position = body.reference.astype(float)
    files = {
        NETWORK: b"none",
        BODY: body_bytes(ModelBody(body, position, position, {"position": position})),
        WEIGHTS: safetensors.torch.save(state),
        CARD: b"# by hand\n",
    }
    said = {
        "muscle": muscle,
        "method": "modes",
        "config": module.built.model_dump(mode="json"),
        "half_width_90": {"position": 1.5},
        "fields": {name: FIELDS[name].unit for name in signature.fields},
        **other,
    }
    return write_model(told(f"modes_{muscle}", signature, **said), files, folder)


def save_arm(folder, muscles=MUSCLES):
    """A folder with a model of each muscle; their networks are the same."""
    for muscle in muscles:
        save_modes(folder / muscle, muscle)
    return folder
