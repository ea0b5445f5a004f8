"""What neural modes are told before they have seen data, and what their module is made of afterwards."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from myograph.config import Model
from myograph.learning.modes.marquardt import Course

Reads = Literal["activation", "sensors", "both"]


class ModesConfig(Model):
    """Settings of the method.

    Parameters
    ----------
    reads
        What answers are made from. A model that reads 'both' also answers from activations alone, when it is given no
        sensors, and from sensors alone, when its activations are NaN.
    coordinate
        First of the two numbers that say what the muscle does: the elbow's 'angle', or, where the cases do not tell
        it, the amount of the leading 'mode' of the positions.
    modes, modes_of
        Of each field, at most; and of single fields, by name, where those should have another number.
    stress
        What von Mises stress is answered by: it follows from the six components of 'cauchy_stress', or 'von_mises'
        has modes of its own, which are a sixth of the numbers.
    kept
        How modes are kept: 'float16' halves a saved model and costs a relative 2e-4 of each mode at each node.
    width, members, steps, decay
        The networks from activations to the coordinate: units of each hidden layer, their number, Levenberg-Marquardt
        steps at most, and the weight of the squared parameters.
    sensing
        What sensors decide: the place on the 'surface' of all shapes that were seen; the amounts of all modes, by
        'ridge' least squares; or 'surface_and_ridge', the place, and the modes as far as it leaves something open.
    sensor_noise
        Standard deviation of a measured coordinate [mm]: how far sensors are followed against activations.
    activation_noise
        Likewise of activations [-].
    seed
        Of the networks' first weights.
    """

    reads: Reads = "activation"
    coordinate: Literal["angle", "mode"] = "angle"
    modes: int = Field(default=32, ge=1)
    modes_of: dict[str, Annotated[int, Field(ge=1)]] = Field(default_factory=dict)
    stress: Literal["cauchy_stress", "von_mises"] = "cauchy_stress"
    kept: Literal["float32", "float16"] = "float32"
    width: int = Field(default=20, ge=1)
    members: int = Field(default=3, ge=1)
    steps: int = Field(default=100, ge=1)
    decay: float = Field(default=1e-7, ge=0)
    sensing: Literal["surface", "ridge", "surface_and_ridge"] = "surface"
    sensor_noise: float = Field(default=0.1, gt=0)
    activation_noise: float = Field(default=0.01, gt=0)
    seed: int = Field(default=0, ge=0, lt=2**63)

    @model_validator(mode="after")
    def _uses_what_it_reads(self) -> "ModesConfig":
        if self.reads == "both" and self.sensing == "ridge":
            raise ValueError(
                "sensing: by 'ridge' sensors decide all amounts, and activations none; set reads = 'sensors'"
            )
        return self

    @property
    def course(self) -> Course:
        """Of each network's fit."""
        return Course(self.width, self.steps, self.decay)


class FieldShape(Model):
    """The modes of one field: numbers of components and modes, degrees along (x, u)."""

    name: str
    components: int = Field(ge=1)
    modes: int = Field(ge=1)
    degrees: tuple[int, int]


class BuiltModes(Model):
    """All that the module needs to be built anew, its numbers aside.

    Parameters
    ----------
    settings
        What it was fitted with.
    own
        Index of the muscle in `myograph.MUSCLES`.
    nodes
        Of the body.
    fields
        Positions first.
    """

    settings: ModesConfig
    own: int = Field(ge=0)
    nodes: int = Field(ge=1)
    fields: tuple[FieldShape, ...]
