"""Methods by name, as a configuration file asks for them.

    do_nothing, affine, thin_plate_spline    nothing is learned
    gappy_pod, pod_gp                        linear algebra and Gaussian processes; no steps
    neural_modes                             its own steps
    gen, gen_thesis, gen_improved, feed_forward, deeponet
                                             trained by `myograph.learning.training`

A method's module is imported when it is asked for.
"""

import difflib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from myograph.config import Model, parse
from myograph.ensemble.pairs.predictor import Learner, Predictor, Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.training.config import TrainingConfig
from myograph.learning.trust.calibrated import CalibratedLearner

M = TypeVar("M", bound=Model)


@dataclass(frozen=True)
class Asked:
    """A method as it is asked for.

    Parameters
    ----------
    method
        Its name.
    options, training
        What is said of the method, and of its training; the rest is as the method has it.
    folder
        Where its training writes checkpoints and logs.
    calibration
        Share of the training cases that is held out, where the method learns, for its 90 % intervals; 0 for none.
    source
        Where this was said, for messages.
    """

    method: str
    options: Mapping[str, Any] = field(default_factory=dict)
    training: Mapping[str, Any] = field(default_factory=dict)
    folder: Path | None = None
    calibration: float = 0.0
    source: str = "options"

    def options_over(self, default: M) -> M:
        """The method's options, over its own; raises InputError for one that it does not have."""
        return _over(default, self.options, f"{self.source}: options of {self.method}")

    def training_over(self, default: TrainingConfig) -> TrainingConfig:
        """Likewise of its training; raises InputError, too, for patience without validation."""
        config = _over(default, self.training, f"{self.source}: training")
        if config.patience is not None and not config.validation:
            raise InputError(
                f"{self.source}: training: patience: expected cases to validate on, got none; set 'validation', such "
                "as 0.1"
            )
        return config

    def check_plain(self, options: bool = False) -> None:
        """Raise InputError for settings of a training; also for any options, unless the method has some."""
        if self.training:
            raise InputError(f"{self.source}: '{self.method}' is not trained in steps: leave [training] out")
        if self.options and not options:
            raise InputError(f"{self.source}: '{self.method}' has no options, got {', '.join(self.options)}")


@dataclass(frozen=True)
class Untaught:
    """A `Learner` of a method that learns nothing."""

    predictor: Predictor

    @property
    def name(self) -> str:
        """As it stands in tables."""
        return self.predictor.name

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> Predictor:
        """The method as it is."""
        return self.predictor


def make_learner(asked: Asked) -> Learner:
    """The method with its settings.

    Raises InputError for a name that is none, and for options that the method does not have.
    """
    make = LEARNERS.get(asked.method)
    if make is None:
        near = difflib.get_close_matches(asked.method, LEARNERS, n=1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise InputError(
            f"{asked.source}: unknown method '{asked.method}': expected one of {', '.join(LEARNERS)}{hint}"
        )
    learner = make(asked)
    if not asked.calibration or isinstance(learner, Untaught):
        return learner
    return CalibratedLearner(learner, asked.calibration)


def _over(default: M, given: Mapping[str, Any], source: str) -> M:
    return parse({**default.model_dump(), **given}, type(default), source)


def _untaught(asked: Asked) -> Learner:
    from myograph.learning.baselines import BASELINES

    asked.check_plain()
    return Untaught(BASELINES[asked.method])


def _gappy_pod(asked: Asked) -> Learner:
    from myograph.learning.baselines.gappy_pod import GappyPod

    asked.check_plain()
    return GappyPod()


def _pod_gp(asked: Asked) -> Learner:
    from myograph.learning.baselines.gp_module import PodGpConfig
    from myograph.learning.baselines.pod_gp import PodGp

    asked.check_plain(options=True)
    return PodGp(asked.options_over(PodGpConfig()))


def _neural_modes(asked: Asked) -> Learner:
    from myograph.learning.modes.config import ModesConfig
    from myograph.learning.modes.learner import ModesLearner

    asked.check_plain(options=True)
    return ModesLearner(asked.options_over(ModesConfig()))


def _gen(asked: Asked) -> Learner:
    from myograph.learning.gen.config import NetworkConfig
    from myograph.learning.gen.learner import GenLearner

    presets = {"gen_thesis": NetworkConfig.thesis, "gen_improved": NetworkConfig.improved}
    network = asked.options_over(presets.get(asked.method, NetworkConfig)())
    called = f"{asked.method}_{network.nodes_per_axis**3}"
    return GenLearner(network, asked.training_over(TrainingConfig()), called, asked.folder)


def _feed_forward(asked: Asked) -> Learner:
    from myograph.learning.baselines.feed_forward import FeedForward

    usual = FeedForward()
    return FeedForward(asked.options_over(usual.network), asked.training_over(usual.training), asked.folder)


def _deeponet(asked: Asked) -> Learner:
    from myograph.learning.baselines.deeponet import DeepONet

    usual = DeepONet()
    return DeepONet(asked.options_over(usual.network), asked.training_over(usual.training), asked.folder)


LEARNERS: dict[str, Callable[[Asked], Learner]] = {
    "do_nothing": _untaught,
    "affine": _untaught,
    "thin_plate_spline": _untaught,
    "gappy_pod": _gappy_pod,
    "pod_gp": _pod_gp,
    "neural_modes": _neural_modes,
    "gen": _gen,
    "gen_thesis": _gen,
    "gen_improved": _gen,
    "feed_forward": _feed_forward,
    "deeponet": _deeponet,
}
"""Method -> what makes its learner."""
