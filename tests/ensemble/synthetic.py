"""A simulator from formulas, for the ensembles' tests: fast, or slow, or faulty where its preset says so."""

import os
import time
from pathlib import Path

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES, Solution
from myograph.ensemble.spec import Body, SimulatorSpec
from myograph.errors import NotConvergedError
from myograph.fields import von_mises

NODES = 60
FACTORY = f"{__name__}:make"
REMEMBERING = f"{__name__}:make_remembering"


def spec(kind=FACTORY, preset=""):
    return SimulatorSpec(kind, preset, built_in_arm().model_dump_json())


def make(spec):
    return Synthetic(spec.preset)


def make_remembering(spec):
    return Remembering(spec.preset)


def options(preset):
    """'nodes=60 sleep=0.01 nan=3 ...' as numbers; what stands after '=' may be a path."""
    return dict(part.split("=") for part in preset.split())


class Synthetic:
    """Fields that follow the activations; a case is recognised by 1000 times its first activation."""

    def __init__(self, preset):
        if "SYNTHETIC_BROKEN" in os.environ:
            raise RuntimeError("broken")
        self.options = options(preset)
        nodes = int(self.options.get("nodes", NODES))
        reference = np.random.default_rng(1).normal(size=(nodes, 3)) * 50
        skin = np.arange(8).reshape(2, 4)
        self.bodies = {name: Body(reference, skin, np.arange(27).reshape(1, 27)) for name in MUSCLES}

    def __call__(self, case):
        self.misbehave(round(1000 * case.activations[0]))
        angle = 1.0 + 0.5 * sum(case.activations) if case.elbow_angle is None else case.elbow_angle
        moments = {name: 1e4 * a / 3 for name, a in zip(MUSCLES, case.activations, strict=True)}
        fields = {name: self.fields(name, case, angle) for name in MUSCLES}
        return Solution(case, angle, moments, fields, "synthetic", ("made of formulas",))

    def fields(self, name, case, angle):
        reference, own = self.bodies[name].reference, case.activations[MUSCLES.index(name)]
        stress = own * np.sin(reference @ np.ones((3, 6)) + np.arange(6) * angle)
        return {
            "position": reference * (1 + own / 7) + case.hand_load,
            "cauchy_stress": stress,
            "von_mises": von_mises(stress),
            "fibre_stretch": 1 - own * np.cos(reference[:, 0]) / 10,
            "pressure": reference[:, 1] * own,
        }

    def misbehave(self, number):
        time.sleep(float(self.options.get("sleep", 0)))
        if number == int(self.options.get("fail", -1)):
            raise NotConvergedError("no way further", residuals=(3.0, 2.0, 2.5))
        if number == int(self.options.get("crash", -1)):
            raise ZeroDivisionError("a bug")
        if number == int(self.options.get("die", -1)):
            os._exit(11)
        if number == int(self.options.get("hang", -1)):
            time.sleep(3600)
        if "asked" in self.options:
            with Path(self.options["asked"]).open("a") as file:
                file.write(f"{number}\n")


class Faulty(Synthetic):
    """Arrays that no store should take, by the number of the case."""

    def fields(self, name, case, angle):
        fields = super().fields(name, case, angle)
        number = round(1000 * case.activations[0])
        if number == 100:
            fields["position"][3, 1] = np.nan
        if number == 200:
            fields["cauchy_stress"] = fields["cauchy_stress"][:, :3]
        if number == 300:
            del fields["pressure"]
        if number == 400:
            fields["von_mises"] = fields["von_mises"] * 1e60 + 1e60
        return fields


def make_faulty(spec):
    return Faulty(spec.preset)


class Remembering(Synthetic):
    """Answers depend a little on the case before, as those of warm starts do."""

    def __init__(self, preset):
        super().__init__(preset)
        self.before = 0.0

    def forget(self):
        self.before = 0.0

    def __call__(self, case):
        solution = super().__call__(case)
        trace, self.before = self.before, float(sum(case.activations))
        moments = {name: moment + trace * 1e-3 for name, moment in solution.moments.items()}
        return Solution(case, solution.elbow_angle + 1e-9 * trace, moments, solution.fields, solution.origin)
