"""The header and the source of a reduced muscle; what is fixed stands in header.template and source.template."""

import re
from dataclasses import dataclass
from importlib.resources import files
from string import Template

import numpy as np

from myograph import __version__
from myograph.errors import InputError
from myograph.export.c.layers import Layers
from myograph.export.c.reduced import asked_activations
from myograph.export.c.wanted import Reduced
from myograph.inference.low_rank import RANGE, LowRankMuscle

MOST_NODES, MEASURED = 65536, 64
"""Nodes that facets can count; activations that the interval of the header is a mean over."""
ROUNDING = 1e-6
_PER_LINE = 12
_STRESS_CODE = {
    "von_mises": """    if (von_mises_mpa != NULL) {
        amounts_of(&stress_field, x, u, amounts);
        for (int i = 0; i < ${guard}_NODES; i++)
            von_mises_mpa[i] = value_of(&stress_field, amounts, i);
    }
""",
    "cauchy_stress": """    if (von_mises_mpa != NULL) {
        amounts_of(&stress_field, x, u, amounts);
        for (int i = 0; i < ${guard}_NODES; i++) {
            float s[6];
            for (int c = 0; c < 6; c++)
                s[c] = value_of(&stress_field, amounts, 6 * i + c);
            const float xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
            const float shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
            von_mises_mpa[i] = sqrtf((xy * xy + yz * yz + zx * zx) / 2.0f + 3.0f * shear);
        }
    }
""",
}
_ANGLE_DECLARATION = """/* Flexion of the elbow [rad]: 0 is straight. */
float ${prefix}_elbow_angle(const float activation[5], float hand_load_n);

"""
_ANGLE_CODE = """
float ${prefix}_elbow_angle(const float activation[5], float hand_load_n)
{
    return $angle_low + (place_of(activation, hand_load_n) + $range) / (2.0f * $range) * ($angle_high - $angle_low);
}
"""


@dataclass(frozen=True)
class Source:
    """Text of the header and of the source, by the names of their files."""

    files: dict[str, str]


def c_source(found: Reduced, prefix: str) -> Source:
    """The two files; functions and files are named by the prefix.

    Raises InputError for a prefix that C does not allow as a name, and for more nodes than facets can count.
    """
    if not re.fullmatch("[A-Za-z][A-Za-z0-9_]{0,60}", prefix):
        raise InputError(f"name in C: expected a letter, then letters, digits and _, got '{prefix}'")
    if len(found.muscle.reference) > MOST_NODES:
        raise InputError(f"{found.muscle.name}: expected at most {MOST_NODES} nodes, got {len(found.muscle.reference)}")
    words = _words(found, prefix)
    return Source({f"{prefix}.h": _filled("header.template", words), f"{prefix}.c": _filled("source.template", words)})


def _filled(name: str, words: dict[str, object]) -> str:
    text = (files("myograph.export.c") / name).read_text(encoding="utf-8")
    return Template(text).substitute(words)


def _words(found: Reduced, prefix: str) -> dict[str, object]:
    """What the templates leave open."""
    muscle, guard = found.muscle, prefix.upper()
    stress = next((name for name in ("von_mises", "cauchy_stress") if name in found.layers), None)
    trained = muscle.trained_range
    words: dict[str, object] = {
        "guard": guard,
        "prefix": prefix,
        "header": f"{prefix}.h",
        "version": __version__,
        "muscle": muscle.muscle,
        "model": _plain(muscle.name),
        "checksum": muscle.checksum,
        "kind": found.kind,
        "modes": ", ".join(f"{count} of {name}" for name, count in found.modes.items()),
        "bytes": found.bytes,
        "errors": ", ".join(f"{value:.3g} {'mm' if k == 'position' else 'MPa'}" for k, value in found.errors.items()),
        "trust": _trust(muscle),
        "low": min(trained.activation_low),
        "high": max(trained.activation_high),
        "load_low": trained.hand_load[0],
        "load_high": trained.hand_load[1],
        "nodes": len(muscle.reference),
        "facets": len(muscle.skin),
        "facet_rows": max(len(muscle.skin), 1),
        "members": len(muscle.angle.last_offset),
        "width": muscle.angle.last.shape[1],
        "most_rows": max(len(layers.rows) for layers in found.layers.values()),
        "most_terms": 1 + max(max(layers.degrees) for layers in found.layers.values()),
        "number": "float" if found.kind == "float" else "signed char",
        "arrays": _arrays(found, prefix),
        "fields": "".join(_field(_called(name), layers) for name, layers in found.layers.items()),
        "most_x": _number(muscle.most_x),
        "range": _number(RANGE),
        "own": muscle.own,
        "stress_comment": "von_mises_mpa: von Mises stress of each node [MPa]; NULL where it is not wanted."
        if stress
        else "Stress was not asked for when this was written.",
        "stress_argument": f", float von_mises_mpa[{guard}_NODES]" if stress else "",
    }
    low, high = muscle.angle.ends or (0.0, 0.0)
    words |= {"angle_low": _number(low), "angle_high": _number(high)}
    known = muscle.angle.ends is not None
    words["stress_code"] = Template(_STRESS_CODE[stress]).substitute(words) if stress else ""
    words["angle_declaration"] = Template(_ANGLE_DECLARATION).substitute(words) if known else ""
    words["angle_code"] = Template(_ANGLE_CODE).substitute(words) if known else ""
    return words


def _trust(muscle: LowRankMuscle) -> str:
    """How far the full model itself is from the truth: times its deviation, over the trained range."""
    times = muscle.half_width_90.get("position")
    if times is None:
        return "That model is not calibrated."
    asked = asked_activations(muscle)[-MEASURED:]
    places = [muscle.place(row[:-1], float(row[-1])) for row in asked]
    widths = times * np.stack([muscle.deviations(place)["position"] for place in places])
    return f"Nine of ten positions of that model are within {widths.mean():.2g} mm of the truth, on average."


def _arrays(found: Reduced, prefix: str) -> str:
    """All numbers."""
    muscle, angle = found.muscle, found.muscle.angle
    trained = muscle.trained_range
    low = np.array([*trained.activation_low, trained.hand_load[0]]) - ROUNDING
    high = np.array([*trained.activation_high, trained.hand_load[1]]) + ROUNDING
    skin = muscle.skin if len(muscle.skin) else np.zeros((1, 4), dtype=int)
    texts = [
        f'const char {prefix}_sha256[65] = "{muscle.checksum}";',
        f"const unsigned short {prefix}_facets[{len(skin)}][4] = {_nested(skin)};",
        _array("trained_low[INPUTS]", low),
        _array("trained_high[INPUTS]", high),
        _array("centre[INPUTS]", angle.centre),
        _array("scale[INPUTS]", angle.scale),
        _array("first[MEMBERS][INPUTS][WIDTH]", angle.first),
        _array("first_offset[MEMBERS][WIDTH]", angle.first_offset),
        _array("second[MEMBERS][WIDTH][WIDTH]", angle.second),
        _array("second_offset[MEMBERS][WIDTH]", angle.second_offset),
        _array("last[MEMBERS][WIDTH]", angle.last),
        _array("last_offset[MEMBERS]", angle.last_offset),
        *(_field_arrays(_called(name), layers) for name, layers in found.layers.items()),
    ]
    return "\n".join(texts) + "\n"


def _called(name: str) -> str:
    return "position" if name == "position" else "stress"


def _field_arrays(name: str, layers: Layers) -> str:
    return "\n".join(
        [
            _array(f"{name}_mean[]", layers.mean),
            _array(f"{name}_weights[]", layers.weights.ravel()),
            f"static const mode_number {name}_modes[] = {_nested(layers.rows.T.ravel())};",
        ]
    )


def _field(name: str, layers: Layers) -> str:
    numbers = f"{layers.degrees[0]}, {layers.degrees[1]}, {len(layers.rows)}"
    return f"static const field {name}_field = {{{numbers}, {name}_mean, {name}_weights, {name}_modes}};\n"


def _array(declared: str, values: np.ndarray) -> str:
    return f"static const float {declared} = {_nested(np.asarray(values, dtype=np.float64))};"


def _nested(values: np.ndarray) -> str:
    """An initialiser with a pair of braces for every axis."""
    if values.ndim > 1:
        return "{\n" + ",\n".join(_nested(part) for part in values) + "}"
    shown = [_number(value) if isinstance(value, float) else str(value) for value in values.tolist()]
    lines = [", ".join(shown[k : k + _PER_LINE]) for k in range(0, len(shown), _PER_LINE)]
    return "{" + ",\n".join(lines) + "}"


def _number(value: float) -> str:
    """A float of C, exact in single precision."""
    text = f"{np.float32(value):.9g}"
    return (text if "." in text or "e" in text else f"{text}.0") + "f"


def _plain(text: str) -> str:
    """Without what would end a comment."""
    return re.sub(r"[^\w .-]", "_", text, flags=re.ASCII)
