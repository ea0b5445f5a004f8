"""A graph element network on a muscle: parts of a question go in, fields come out, both in mm and MPa.

All scaling is inside, as buffers, so that the module is all that has to be saved. With an activation input, activations
that are NaN are not known, and a question without sensors is answered from activations alone.
"""

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.case import MUSCLES
from myograph.ensemble.pairs.features import FIELD, WIDTH
from myograph.errors import InputError
from myograph.learning.gen.affine import affine_map
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.features import MOVED, feature_of, field_of, width_of
from myograph.learning.gen.network import GraphElementNetwork, Samples
from myograph.learning.gen.precision import single
from myograph.learning.gen.scaling import Scaling

PART = "sensor_{}_target"


class MuscleGen(nn.Module):
    """The network with its scaling; raises InputError for outputs that contradict each other.

    Parameters
    ----------
    scaling
        Fitted to training data, or blank where weights are loaded afterwards; buffers hold what counts.
    seed
        Of the graph's first nodes and the weights.
    """

    lowest: Tensor
    length: Tensor
    input_offset: Tensor
    input_unit: Tensor
    output_offset: Tensor
    output_unit: Tensor

    def __init__(self, config: NetworkConfig, scaling: Scaling, seed: int) -> None:
        super().__init__()
        _check(config)
        self.config, self.scaling = config, scaling
        self.inputs, self.outputs = input_names(config), output_names(config)
        raw = config.traps.millimetres
        self.network = GraphElementNetwork(
            config,
            scaling.sides if raw else scaling.sides / scaling.length,
            [width_of(kinds) for kinds in config.inputs],
            [width_of(kinds) for kinds in config.outputs],
            seed,
            constants=len(MUSCLES) + 1 if config.activation_input else 0,
        )
        self.register_buffer("lowest", torch.tensor(scaling.lowest, dtype=torch.float32))
        self.register_buffer("length", torch.tensor(1.0 if raw else scaling.length))
        for role, kinds in (("input", config.input_features), ("output", config.output_features)):
            for part in ("offset", "unit"):
                numbers = [getattr(scaling.features[kind], part) for kind in kinds]
                self.register_buffer(f"{role}_{part}", torch.tensor(np.concatenate(numbers), dtype=torch.float32))

    @property
    def nodes_mm(self) -> Float[np.ndarray, "nodes 3"]:
        """Where the graph's nodes are [mm]."""
        with torch.no_grad():
            return (self.network.nodes * self.length + self.lowest).cpu().double().numpy()

    def forward(self, *arguments: Tensor) -> tuple[Tensor, ...]:
        """Fields at the queries, named by `outputs`, of the parts of a question that `inputs` names."""
        parts = dict(zip(self.inputs, arguments, strict=True))
        return self.fields_of(self.scaled(parts), parts)

    def fields_of(self, scaled: Float[Tensor, "batch queries width"], parts: dict[str, Tensor]) -> tuple[Tensor, ...]:
        """Fields [mm], [MPa] that scaled values of all output functions say."""
        values = scaled * self.output_unit + self.output_offset
        if self.config.skip == "affine":
            values = values + self.known_part(parts)
        fields, first = [], 0
        for kind in self.config.output_features:
            last = first + WIDTH[kind]
            fields.append(field_of(kind, values[..., first:last], parts.get("query_position_initial")))
            first = last
        return tuple(fields)

    def scaled(self, parts: dict[str, Tensor]) -> Float[Tensor, "batch queries width"]:
        """What the network says, all output functions side by side [-]."""
        queries = self._into_box(parts["query_places"])
        answers = self.network(self._given(parts), queries, self._constants(parts, queries))
        return torch.cat(answers, dim=-1)

    def known_part(self, parts: dict[str, Tensor]) -> Float[Tensor, "batch queries 3"]:
        """Displacements by the affine map that suits the sensors best [mm], in single precision."""
        before, after = parts["sensor_position_initial"], parts["sensor_position_target"]
        with single(before):
            return affine_map(before, after - before, parts["query_position_initial"])

    def wanted(self, parts: dict[str, Tensor], truth: dict[str, Tensor]) -> Float[Tensor, "batch queries width"]:
        """What `scaled` should be, where the target case is known [-]."""
        initial = parts.get("query_position_initial")
        values = torch.cat([feature_of(kind, initial, truth) for kind in self.config.output_features], dim=-1)
        if self.config.skip == "affine":
            values = values - self.known_part(parts)
        return (values - self.output_offset) / self.output_unit

    def _into_box(self, places: Float[Tensor, "batch points 3"]) -> Float[Tensor, "batch points 3"]:
        return (places - self.lowest) / self.length

    def _given(self, parts: dict[str, Tensor]) -> list[Samples] | None:
        if "sensor_places" not in parts:
            return None
        places = self._into_box(parts["sensor_places"])
        target = {FIELD[kind]: parts[PART.format(FIELD[kind])] for kind in self.config.input_features}
        initial, given, first = parts.get("sensor_position_initial"), [], 0
        for kinds in self.config.inputs:
            values = torch.cat([feature_of(kind, initial, target) for kind in kinds], dim=-1)
            part = slice(first, first + values.shape[-1])
            given.append((places, (values - self.input_offset[part]) / self.input_unit[part]))
            first = part.stop
        return given

    def _constants(self, parts: dict[str, Tensor], queries: Tensor) -> Float[Tensor, "batch constants"] | None:
        """Activations and whether they are known."""
        if not self.config.activation_input:
            return None
        if "activation" not in parts:
            return queries.new_zeros(queries.shape[0], len(MUSCLES) + 1)
        activation = parts["activation"]
        known = activation.isnan().logical_not().all(dim=-1, keepdim=True)
        return torch.cat([torch.where(known, activation, 0.0), known.to(activation)], dim=-1)


def input_names(config: NetworkConfig) -> tuple[str, ...]:
    """Parts of a question that the module reads, in the order of its arguments."""
    names = ["activation"] if config.activation_input and config.reads != "sensors" else []
    if config.reads != "activation":
        kinds = set(config.input_features)
        names.append("sensor_places")
        if kinds & set(MOVED) or config.skip == "affine":
            names.append("sensor_position_initial")
        fields = {FIELD[kind] for kind in kinds} | ({"position"} if config.skip == "affine" else set())
        names += [PART.format(field) for field in sorted(fields)]
    names.append("query_places")
    if set(config.output_features) & set(MOVED):
        names.append("query_position_initial")
    return tuple(names)


def output_names(config: NetworkConfig) -> tuple[str, ...]:
    """Fields that the module answers, in the order of its results."""
    return tuple(FIELD[kind] for kind in config.output_features)


def _check(config: NetworkConfig) -> None:
    answers = config.output_features
    fields = output_names(config)
    if not fields or not all(config.outputs) or len(set(fields)) < len(fields):
        raise InputError(f"outputs: expected features of different fields, got {', '.join(answers) or 'none'}")
    if not config.inputs or not all(config.inputs):
        raise InputError("inputs: expected features at the sensors, got none")
    if config.reads != "sensors" and not config.activation_input:
        raise InputError(f"reads '{config.reads}': expected a network with an activation input; set activation_input")
    if config.physics.minded and "position" not in fields:
        raise InputError(f"physics: expected a network that answers positions, got {', '.join(fields)}")
    if config.physics.volume and config.traps.legacy_axis:
        raise InputError("physics: with the trap 'legacy_axis' an answer has no derivative of its own; set volume to 0")
    if config.skip == "affine" and (answers != ("displacement",) or config.activation_input):
        raise InputError(
            "skip 'affine': expected 'displacement' as the only output, and no activation input, which must do "
            "without sensors"
        )
