r"""What keeps a muscle out of the bones and on the arm: energies on its skin.

    W = ∫ k s(-g)² / 2 dA,   s(v) = w log(1 + exp(v / w))

with g the gap to a rigid obstacle: a pulley (cylinder about the hinge's axis), a bone (capsule), or an elastic band,
which holds a piece of the muscle near a bone and lets it slide along. The bones of the forearm turn with it: their
gaps are taken at the place where a point was before the forearm turned.

Traps: s is smooth, else Newton chatters, and vanishes exponentially: an algebraic tail pushes from afar as hard as a
slack muscle pulls. A bone does not push where the muscle grows out of it, the first and the last tenth. Obstacles are
stiff on the tendon and soft on the belly: a part of k shrinks where the section is over 50 mm². The humerus ends at the
hinge: as an endless line it blocks the insertion.
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np

from myograph.anatomy.hinge import Hinge
from myograph.anatomy.model import ATTACHED, Arm, Bone, Contact

_TENDON_AREA = 50.0
"""Section [mm²] above which obstacles are softer."""
Field = ngs.CoefficientFunction


@dataclass(frozen=True)
class Turn:
    """Cosine and sine of the flexion from the reference pose, as parameters that change between solves."""

    cosine: ngs.Parameter
    sine: ngs.Parameter

    def set(self, flexion: float) -> None:
        """Set both for a flexion [rad] from the reference pose."""
        self.cosine.Set(float(np.cos(flexion)))
        self.sine.Set(float(np.sin(flexion)))


@dataclass(frozen=True)
class Skin:
    """Points of the skin: where they are now [mm], along the muscle (0 to 1), area of their section [mm²]."""

    place: Field
    along: Field
    area: Field


def fixed_energy(arm: Arm, contact: Contact, skin: Skin) -> Field | None:
    """Energy per skin area [N/mm] of the pulley and of the bones that stand still; None without obstacles."""
    energies = []
    if contact.pulley > 0:
        gap = _axis_distance(arm.hinge.frame(), skin.place) - contact.pulley
        energies.append(_on_tendon(contact, skin) * _penalty(gap, contact.softness))
    fixed = [arm.bones[name] for name in contact.bones if arm.bones[name].moves_with == "upper arm"]
    energies += [_bone_energy(bone, contact, skin, skin.place) for bone in fixed]
    return _sum(energies)


def turning_energy(arm: Arm, contact: Contact, skin: Skin, turn: Turn) -> Field | None:
    """Energy per skin area [N/mm] of all that depends on the elbow's angle, and of the bands; None without them."""
    before = _unturned(arm.hinge.frame(), skin.place, turn)
    turning = [arm.bones[name] for name in contact.bones if arm.bones[name].moves_with == "forearm"]
    energies = [_bone_energy(bone, contact, skin, before) for bone in turning]
    for band in contact.bands:
        bone = arm.bones[band.bone]
        window = ngs.exp(-(((skin.along - band.place) / band.width) ** 2))
        distance = _capsule_distance(bone, before if bone.moves_with == "forearm" else skin.place)
        energies.append(band.stiffness * window * _penalty(band.reach - distance, band.softness))
    return _sum(energies)


def _bone_energy(bone: Bone, contact: Contact, skin: Skin, place: Field) -> Field:
    """Of one bone, with the skin at `place` while the bone stands as in the reference pose."""
    stiffness = _ramp(skin.along) * _ramp(1 - skin.along) * (contact.stiffness + _on_tendon(contact, skin))
    return stiffness * _penalty(_capsule_distance(bone, place) - bone.radius, contact.softness)


def _on_tendon(contact: Contact, skin: Skin) -> Field:
    """Stiffness [N/mm³] that shrinks where the section grows beyond that of a tendon."""
    return contact.tendon_stiffness * _TENDON_AREA / (_TENDON_AREA + _positive(skin.area - _TENDON_AREA))


def _positive(value: Field) -> Field:
    """Smooth positive part, over 1 mm²."""
    return 0.5 * (value + ngs.sqrt(value * value + 1))


def _ramp(share: Field) -> Field:
    """From 0 at an end of the muscle to 1 at the end of the attached tenth."""
    clamped = ngs.IfPos(share, ngs.IfPos(share - ATTACHED, 1.0, share / ATTACHED), 0.0)
    return clamped * clamped


def _unturned(hinge: Hinge, place: Field, turn: Turn) -> Field:
    """Where a place was before the forearm turned."""
    offset = place - _cf(hinge.point)
    forward, up, lateral = (ngs.InnerProduct(offset, _cf(axis)) for axis in (hinge.forward, hinge.up, hinge.axis))
    turned = (turn.cosine * forward + turn.sine * up) * _cf(hinge.forward)
    return (
        _cf(hinge.point) + turned + (turn.cosine * up - turn.sine * forward) * _cf(hinge.up) + lateral * _cf(hinge.axis)
    )


def _penalty(gap: Field, softness: float) -> Field:
    """Half the square of the smooth depth; written so that no exponential overflows."""
    size = ngs.IfPos(gap, gap, -gap)
    depth = ngs.IfPos(gap, 0.0, -gap) + softness * ngs.log(1 + ngs.exp(-size / softness))
    return 0.5 * depth * depth


def _axis_distance(hinge: Hinge, place: Field) -> Field:
    offset = place - _cf(hinge.point)
    forward, up = ngs.InnerProduct(offset, _cf(hinge.forward)), ngs.InnerProduct(offset, _cf(hinge.up))
    return ngs.sqrt(forward * forward + up * up + 1e-6)


def _capsule_distance(bone: Bone, place: Field) -> Field:
    start, end = np.array(bone.start), np.array(bone.end)
    offset = place - _cf(start)
    share = ngs.InnerProduct(offset, _cf(end - start)) / float((end - start) @ (end - start))
    inside = ngs.IfPos(share, ngs.IfPos(share - 1, 1.0, share), 0.0)
    rest = offset - inside * _cf(end - start)
    return ngs.sqrt(ngs.InnerProduct(rest, rest) + 1e-6)


def _sum(energies: list[Field]) -> Field | None:
    return sum(energies[1:], energies[0]) if energies else None


def _cf(vector: np.ndarray) -> Field:
    return ngs.CoefficientFunction(tuple(map(float, vector)))
