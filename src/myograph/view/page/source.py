"""The models of an arm that a page is made of, and the anatomy that they were made with."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.inference.low_rank import LowRankMuscle, read_low_rank_arm
from myograph.inference.model_file import MODEL_FILE, ModelFile, read_model_file
from myograph.mesh.presets import RESOLUTIONS, preset_mesh
from myograph.mesh.tissue import tendon_share

SAME_PLACE = 1e-2
"""How far [mm] nodes of a mesh made anew may be from the model's, which are single precision."""


@dataclass(frozen=True)
class ArmModels:
    """Models by muscle.

    Parameters
    ----------
    name
        Of the folder.
    muscles, told
        The models, and what their files say.
    arm
        The anatomy that they were made with; None where it is not at hand.
    """

    name: str
    muscles: Mapping[str, LowRankMuscle]
    told: Mapping[str, ModelFile]
    arm: Arm | None


def read_arm_models(folder: Path, arm: Arm) -> ArmModels:
    """The models in a folder: one for each muscle, or a single one. `arm` is taken where it is theirs.

    Raises InputError as `read_low_rank_arm` does.
    """
    muscles = read_low_rank_arm(folder)
    inside = [path for path in sorted(folder.iterdir()) if (path / MODEL_FILE).is_file()]
    folders = [folder] if (folder / MODEL_FILE).is_file() else inside
    told = {model.muscle: model for model in map(read_model_file, folders)}
    made_with = {model.origin.arm_checksum for model in told.values()}
    return ArmModels(folder.resolve().name, muscles, told, arm if made_with == {arm_checksum(arm)} else None)


def tendon(models: ArmModels, muscle: str) -> Float[np.ndarray, " nodes"] | None:
    """Share of tendon at each node; None where the mesh cannot be made anew."""
    preset = models.told[muscle].origin.preset
    if models.arm is None or preset not in RESOLUTIONS:
        return None
    mesh = preset_mesh(models.arm, muscle, preset)
    reference = models.muscles[muscle].reference
    if mesh.points.shape != reference.shape or not np.allclose(mesh.points, reference, rtol=0, atol=SAME_PLACE):
        return None
    return tendon_share(models.arm, muscle, mesh)
