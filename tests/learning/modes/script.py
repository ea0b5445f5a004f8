"""Neural modes that are fitted, saved and asked again: `python -m tests.learning.modes.script FOLDER`.

In a process of its own: signatures that are checked while torch traces a module fix its number of pairs.
"""

import json
import sys
from pathlib import Path

import numpy as np

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.loaded import load
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.saving import Training, load_torch, save_model
from tests.learning.modes.block import block

SETTINGS = (
    {"reads": "activation"},
    {"reads": "sensors", "sensing": "ridge"},
    {"reads": "both"},
    {"reads": "both", "sensing": "surface_and_ridge", "stress": "von_mises"},
)


def main(folder):
    """Tell for each of the settings: parity, and how far any answer is from before, over its largest value."""
    cases = block()
    sampler = PairSampler(cases, np.array([0, 8, 13, 20]), asked=("position", "cauchy_stress", "von_mises"))
    split = split_pairs(cases, "off_grid")
    question = sampler.batch(split.test[:3]).question
    rows = []
    for number, settings in enumerate(SETTINGS):
        model = ModesLearner(ModesConfig(modes=4, width=4, members=2, steps=10, **settings)).fit(sampler, split)
        place = folder / str(number)
        parity = save_model(model, Training(cases, split), place).parity
        apart = max(
            _apart(model.predict(question), again.predict(question)) for again in (load(place), load_torch(place))
        )
        rows.append({"parity": parity, "apart": apart})
    sys.stdout.write(json.dumps(rows))


def _apart(wanted, found):
    pairs = [(getattr(wanted, kind), getattr(found, kind)) for kind in ("values", "deviation")]
    return max(np.abs(of[name] - found[name]).max() / np.abs(of[name]).max() for of, found in pairs for name in of)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
