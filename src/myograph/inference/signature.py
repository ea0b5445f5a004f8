"""What a model takes and gives, by name: the same in torch, in ONNX and in model.json.

Inputs, float32, batch first, mm, MPa, N, in the order of the model's arguments:

    activation               batch muscles      of the target case
    hand_load                batch              of the target case
    sensor_places            batch sensors 3    X or S by the convention
    sensor_FIELD_initial     batch sensors ...  FIELD is position, von_mises, ...
    sensor_FIELD_target      batch sensors ...
    query_places             batch queries 3
    query_FIELD_initial      batch queries ...
    sensor_nodes             sensors            which nodes of the body; int64, no batch
    query_nodes              queries            likewise

Outputs, float32, in order:

    FIELD                    batch queries ...  in the target case, in the unit of the field
    FIELD_deviation          batch queries      standard deviation; of 'position' that of the distance
    sensor_residual          batch              what the model cannot explain of what its sensors say [mm]
"""

import re
from typing import Annotated

from pydantic import Field

from myograph.config import Model
from myograph.ensemble.pairs.question import Convention
from myograph.fields import FIELDS

DEVIATION, RESIDUAL = "_deviation", "sensor_residual"


class Signature(Model):
    """What a model takes and gives.

    Parameters
    ----------
    inputs, outputs
        Names, in the order of the model's arguments and results.
    convention
        How its points are named.
    sensors
        Nodes that were its sensors in training; none where it takes no sensors.
    any_sensors
        Whether it answers from other sensors too, in any number from `least_sensors` on; 0 means: also from none.
    unknown_activation
        Whether it answers where the activations are not known: all of them NaN.
    sensor_noise
        Standard deviation of a measured coordinate [mm] that its deviations are made for; None where it knows none.
    """

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    convention: Convention = "initial"
    sensors: tuple[int, ...] = ()
    any_sensors: bool = False
    least_sensors: int = 1
    unknown_activation: bool = False
    sensor_noise: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None

    @property
    def takes_sensors(self) -> bool:
        """Whether it answers from sensors."""
        return any(name.startswith("sensor_") for name in self.inputs)

    @property
    def fields(self) -> tuple[str, ...]:
        """What an answer holds; von Mises stress wherever there is Cauchy stress."""
        own = tuple(name for name in self.outputs if name in FIELDS)
        return (*own, "von_mises") if "cauchy_stress" in own and "von_mises" not in own else own

    @property
    def rest_fields(self) -> tuple[str, ...]:
        """Fields of the initial state that it is told; 'position' always."""
        told = (re.fullmatch("(?:sensor|query)_(.+)_initial", name) for name in self.inputs)
        return tuple(sorted({"position", *(match[1] for match in told if match)}))
