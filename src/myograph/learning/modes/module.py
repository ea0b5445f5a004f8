r"""Neural modes as one torch module: parts of a question go in, fields, deviations and the sensors' residual come out.

    activations, load --networks--> x, σ_x ┐
    own activation -----------------> u   ─┴─> (x, u) and covariance L Lᵀ <-- Gauss-Newton on sensors
    field = mean + Φ c(x, u),    deviation² = |∂field/∂(x, u) L|² + misfit²

Places are found in double precision, for a residual of micrometres is the difference of hundreds of millimetres; fields
are made in single. Everything is at the nodes: `myograph.mesh.between` carries it to points between them.
"""

import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.case import MUSCLES
from myograph.learning.modes.angle_network import AngleNetwork
from myograph.learning.modes.chebyshev import RANGE
from myograph.learning.modes.config import BuiltModes
from myograph.learning.modes.field_modes import FieldModes, Shapes
from myograph.learning.modes.locating import Known, Located, best_of_grid, locate, nothing_known
from myograph.learning.modes.ridge import ridge_amounts
from myograph.learning.modes.stress import von_mises_change

Parts = dict[str, Tensor]
READS = {
    "activation": ("activation", "hand_load"),
    "sensors": ("sensor_position_target", "sensor_nodes"),
    "both": ("activation", "hand_load", "sensor_position_target", "sensor_nodes"),
}
DEVIATIONS = {
    "position": "position_deviation",
    "cauchy_stress": "von_mises_deviation",
    "von_mises": "von_mises_deviation",
}
KEPT = {"float32": torch.float32, "float16": torch.float16}
SMALLEST = 1e-6
"""Least standard deviation of x [-]: single precision resolves no less."""


class ModesModule(nn.Module):
    """Blank until `myograph.learning.modes.learner` or saved numbers fill it.

    `angle_range` holds the elbow's angles [rad] at x = -RANGE and x = RANGE; NaN where x is no angle.
    """

    angle_misfit: Tensor
    angle_range: Tensor

    def __init__(self, built: BuiltModes) -> None:
        super().__init__()
        settings = built.settings
        self.built, self.settings = built, settings
        self.inputs: tuple[str, ...] = (*READS[settings.reads], "query_nodes")
        self.outputs = output_names(built)
        told, kept = settings.reads != "sensors", KEPT[settings.kept]
        self.angle = AngleNetwork(len(MUSCLES) + 1, settings.width, settings.members) if told else None
        self.fields = nn.ModuleDict({shape.name: FieldModes(shape, built.nodes, kept) for shape in built.fields})
        self.register_buffer("angle_misfit", torch.tensor(SMALLEST))
        self.register_buffer("angle_range", torch.full((2,), torch.nan, dtype=torch.float64))

    @property
    def position(self) -> FieldModes:
        """The field that places are found by."""
        position = self.fields["position"]
        assert isinstance(position, FieldModes)
        return position

    def forward(self, *arguments: Tensor) -> tuple[Tensor, ...]:
        """Outputs by the names of `outputs`, of the parts of a question that `inputs` names."""
        parts: Parts = dict(zip(self.inputs, arguments, strict=True))
        located, answers = self._located(parts)
        sensed = answers.pop("amounts", None)
        spread = _spread(located)
        for name, field in self.fields.items():
            assert isinstance(field, FieldModes)
            amounts = spread @ field.tangent(located.place)
            if sensed is not None and name == "position" and self.settings.sensing != "surface":
                amounts = torch.cat([sensed.unsqueeze(1), amounts[:, 1:]], dim=1)
            found = _field(name, field, amounts.float())
            answers |= {key: values.index_select(1, parts["query_nodes"]) for key, values in found.items()}
        return tuple(answers[name].float() for name in self.outputs)

    def place(
        self, activation: Float[Tensor, "batch muscles"], hand_load: Float[Tensor, " batch"]
    ) -> tuple[Float[Tensor, "batch 2"], Float[Tensor, " batch"]]:
        """(x, u) that activations say, and the standard deviation of x.

        Trap: ONNX exporters leave out the sum with a constant below 1e-8, so that nothing is added to squares of x.
        """
        assert self.angle is not None
        x, spread = self.angle(activation, hand_load)
        own = RANGE * (2 * activation[:, self.built.own].double() - 1)
        deviation = self.angle_misfit * ((spread / self.angle_misfit).square() + 1).sqrt()
        return torch.stack([x, own], dim=-1), deviation

    def _located(self, parts: Parts) -> tuple[Located, Parts]:
        """Place and covariance, and what sensors say beyond these."""
        if self.settings.reads == "activation":
            place, deviation = self.place(parts["activation"], parts["hand_load"])
            nothing = torch.zeros_like(deviation)
            return Located(place, torch.stack([deviation, nothing, nothing], dim=-1)), {}
        sensors = Shapes(*(part.double() for part in self.position.at(parts["sensor_nodes"])))
        moved = parts["sensor_position_target"].double().flatten(1) - sensors.mean
        start, known = self._start(parts, moved, sensors)
        located = locate(moved, start, known, self.position, sensors, self.settings.sensor_noise)
        return located, self._sensed(moved, sensors, located)

    def _start(
        self, parts: Parts, moved: Float[Tensor, "batch values"], sensors: Shapes
    ) -> tuple[Float[Tensor, "batch 2"], Known]:
        """First guess, and what is known of the place beforehand."""
        sought, blank = best_of_grid(moved, self.position, sensors), nothing_known(moved)
        if self.settings.reads == "sensors":
            return sought, blank
        told = parts["activation"].isnan().logical_not().all(dim=-1, keepdim=True)
        place, deviation = self.place(torch.where(told, parts["activation"], 0.5), parts["hand_load"])
        own = torch.full_like(deviation, 2 * RANGE * self.settings.activation_noise)
        precision = torch.stack([deviation, own], dim=-1).square().reciprocal()
        known = Known(torch.where(told, place, blank.place), torch.where(told, precision, blank.precision))
        return torch.where(told, place, sought), known

    def _sensed(self, moved: Float[Tensor, "batch values"], sensors: Shapes, located: Located) -> Parts:
        """Amounts of the position modes, and how far the sensors are from what these say [mm]."""
        noise, position = self.settings.sensor_noise, self.position
        amounts = position.tangent(located.place)[:, 0]
        if self.settings.sensing == "ridge":
            amounts = ridge_amounts(moved, sensors.modes, position.spread, noise)
        elif self.settings.sensing == "surface_and_ridge":
            missed = moved - amounts @ sensors.modes.T
            amounts = amounts + ridge_amounts(missed, sensors.modes, position.left_over, noise)
        missed = moved - amounts @ sensors.modes.T
        count = torch.ones_like(missed).sum(dim=-1).clamp_min(3) / 3
        residual = (missed.square().sum(dim=-1) / count).sqrt()
        return {"amounts": amounts, "sensor_residual": residual}


def output_names(built: BuiltModes) -> tuple[str, ...]:
    """What the module gives, in order."""
    names = [shape.name for shape in built.fields]
    names += [DEVIATIONS[name] for name in names if name in DEVIATIONS]
    return (*names, "sensor_residual") if built.settings.reads != "activation" else tuple(names)


def _spread(located: Located) -> Float[Tensor, "batch 3 3"]:
    """What makes, of amounts and their slopes, amounts and their changes by one deviation of the place each way."""
    corner = located.root.new_tensor([[0.0] * 4 + [1, 0, 0, 0, 0], [0.0] * 5 + [1, 0, 0, 0], [0.0] * 8 + [1]])
    rows = located.root @ corner + located.root.new_tensor([1.0] + [0.0] * 8)
    return rows.reshape(-1, 3, 3)


def _field(name: str, field: FieldModes, amounts: Float[Tensor, "batch 3 modes"]) -> Parts:
    """The field of the first amounts at all nodes, and its deviation by the others, which are changes."""
    if name not in DEVIATIONS:
        values = field.carried(amounts[:, :1]).squeeze(1) + field.mean
        return {name: values if field.shape.components > 1 else values.squeeze(-1)}
    first, changes = field.carried(amounts).split([1, 2], dim=1)
    values = first.squeeze(1) + field.mean
    if name == "position":
        squares = changes.square().sum(dim=(1, 3))
    elif name == "cauchy_stress":
        squares = von_mises_change(values.unsqueeze(1), changes).square().sum(dim=1)
    else:
        squares = changes.squeeze(-1).square().sum(dim=1)
    deviation = (squares + field.misfit.square()).sqrt()
    return {name: values if field.shape.components > 1 else values.squeeze(-1), DEVIATIONS[name]: deviation}
