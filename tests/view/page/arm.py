"""A stand-in arm with its truth and a movement, and the page that is made of them."""

from dataclasses import replace

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.fields import von_mises
from myograph.inference.body_file import ModelBody, body_bytes
from myograph.inference.model_file import BODY, CARD, NETWORK, WEIGHTS
from myograph.inference.truth import write_truth
from myograph.inference.writing import write_model
from myograph.limb.motion.activation_file import Activations
from myograph.view.page import PageArm, page_content, read_arm_models, read_truth_cases
from tests.inference.low_rank.stand_in import save_arm
from tests.inference.stand_in import FROM_SENSORS, MEAN, network, told

APART = 0.3  # mm, in y at every node of the truth
CASES = 5
TIMES = np.array([0.0, 1.0, 2.0])


def make_arm(folder):
    """Models of all five muscles, made with the built-in arm."""
    models = read_arm_models(save_arm(folder), built_in_arm())
    return replace(models, arm=built_in_arm())


def truth_folder(folder, models):
    """Files of five cases that are what the models say, but for 0.3 mm; stress is a tenth more."""
    activation = np.random.default_rng(1).random((CASES, 5))
    for name, muscle in models.muscles.items():
        answers = [muscle.at(row) for row in activation]
        fields = {
            "position": np.stack([answer["position"] + [0, APART, 0] for answer in answers]),
            "von_mises": np.stack([1.1 * von_mises(answer["cauchy_stress"]) for answer in answers]),
        }
        body = Body(muscle.reference, muscle.skin, muscle.cells)
        cases = cases_in_memory(name, body, activation, ["off_grid"] * CASES, fields, np.linspace(1, 2, CASES))
        write_truth(folder / f"{name}.npz", cases, np.arange(CASES), ("position", "von_mises"))
    return folder


def movement():
    """All muscles from rest to full activation and back."""
    return Activations(MUSCLES, TIMES, np.array([0.0, 1.0, 0.0])[:, None] * np.ones(5))


def whole_content(models, folder):
    """The page's content with truth and movement."""
    cases = read_truth_cases(truth_folder(folder, models), models.muscles)
    return page_content(PageArm(models, cases, movement(), "up and down"))


def save_network(folder, models, muscle="biceps", **other):
    """A network that is asked anywhere: every point moves as four sensors do on average; it knows the models' body."""
    known = models.muscles[muscle]
    rest = known.at(np.zeros(5))["position"]
    body = Body(known.reference.astype(np.float32), known.skin, known.cells)
    reached = ModelBody(body, rest - 50, rest + 50, {"position": rest})
    sensors = tuple(np.linspace(3, len(rest) - 4, 4).astype(int).tolist())
    signature = MEAN.model_copy(update={"sensors": sensors, **other.pop("signature", {})})
    files = {
        NETWORK: network(other.pop("text", FROM_SENSORS)),
        BODY: body_bytes(reached),
        WEIGHTS: other.pop("weights", b"none"),
        CARD: b"# by hand\n",
    }
    return write_model(told("mean", signature, **{"muscle": muscle, **other}), files, folder)
