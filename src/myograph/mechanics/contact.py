r"""What keeps a muscle out of the bones and on the forearm: energies on its skin.

    W = ∫ k pos(-g)² / 2 dA,   k = stiffness * full_area / max(A, full_area)

with g the gap to a rigid obstacle: a pulley (cylinder about the hinge's axis), a bone (capsule), or a band that keeps
a piece of the muscle near the forearm's axis while it slides along it. Stiff on the slim tendon, soft on the belly.

Traps: the positive part is smooth over about 1 mm, else Newton chatters. A bone does not push where the muscle grows
out of it, which is its first tenth. The humerus ends at the hinge: as an endless line it blocks the insertion.
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np

from myograph.anatomy.hinge import Hinge
from myograph.anatomy.model import Arm, Band, Bone, Contact
from myograph.mechanics.law import positive

_ATTACHED = 0.10


@dataclass(frozen=True)
class Turn:
    """Cosine and sine of the flexion from the reference pose, as parameters that change between solves."""

    cosine: ngs.Parameter
    sine: ngs.Parameter

    def set(self, flexion: float) -> None:
        """Set both for a flexion [rad] from the reference pose."""
        self.cosine.Set(float(np.cos(flexion)))
        self.sine.Set(float(np.sin(flexion)))


def fixed_contact_energy(
    arm: Arm,
    contact: Contact,
    place: ngs.CoefficientFunction,
    along: ngs.CoefficientFunction,
    area: ngs.CoefficientFunction,
) -> ngs.CoefficientFunction | None:
    """Energy per skin area [N/mm] of the pulley and of the bones that stand still; None without obstacles."""
    hinge = arm.hinge.frame()
    stiffness = _stiffness(contact, area)
    grown = ngs.IfPos(along - _ATTACHED, 1.0, (along / _ATTACHED) ** 2)
    energies = []
    if contact.pulley > 0:
        energies.append(_penalty(_axis_distance(hinge, place) - contact.pulley, contact.softness))
    for name in contact.bones:
        gap = _capsule_distance(arm.bones[name], place) - arm.bones[name].radius
        energies.append(grown * _penalty(gap, contact.softness))
    return stiffness * sum(energies[1:], energies[0]) if energies else None


def band_energy(
    arm: Arm, band: Band, place: ngs.CoefficientFunction, along: ngs.CoefficientFunction, turn: Turn
) -> ngs.CoefficientFunction:
    """Energy per skin area [N/mm] of an elastic band to the forearm, with which it turns."""
    window = ngs.exp(-(((along - band.place) / band.width) ** 2))
    return band.stiffness * window * _penalty(band.reach - _forearm_distance(arm, place, turn), band.softness)


def _forearm_distance(arm: Arm, place: ngs.CoefficientFunction, turn: Turn) -> ngs.CoefficientFunction:
    """Distance from the forearm's axis, which runs from the hinge to the wrist [mm]."""
    hinge = arm.hinge.frame()
    wrist = np.mean([np.array(bone.end) for bone in arm.bones.values() if bone.moves_with == "forearm"], axis=0)
    direction = wrist - hinge.point
    forward, up, lateral = hinge.to_plane(hinge.point + direction / np.linalg.norm(direction))
    turned = (turn.cosine * forward - turn.sine * up, turn.sine * forward + turn.cosine * up)
    axis = sum((turned[1] * _cf(hinge.up), lateral * _cf(hinge.axis)), turned[0] * _cf(hinge.forward))
    offset = place - _cf(hinge.point)
    rest = offset - ngs.InnerProduct(offset, axis) * axis
    return ngs.sqrt(ngs.InnerProduct(rest, rest) + 1e-6)


def _stiffness(contact: Contact, area: ngs.CoefficientFunction) -> ngs.CoefficientFunction:
    return contact.stiffness * contact.full_area / (contact.full_area + positive(area - contact.full_area, 1.0))


def _penalty(gap: ngs.CoefficientFunction, softness: float) -> ngs.CoefficientFunction:
    depth = positive(-gap, softness)
    return 0.5 * depth * depth


def _axis_distance(hinge: Hinge, place: ngs.CoefficientFunction) -> ngs.CoefficientFunction:
    offset = place - _cf(hinge.point)
    forward, up = ngs.InnerProduct(offset, _cf(hinge.forward)), ngs.InnerProduct(offset, _cf(hinge.up))
    return ngs.sqrt(forward * forward + up * up + 1e-6)


def _capsule_distance(bone: Bone, place: ngs.CoefficientFunction) -> ngs.CoefficientFunction:
    start, end = np.array(bone.start), np.array(bone.end)
    offset = place - _cf(start)
    share = ngs.InnerProduct(offset, _cf(end - start)) / float((end - start) @ (end - start))
    inside = ngs.IfPos(share, ngs.IfPos(share - 1, 1.0, share), 0.0)
    rest = offset - inside * _cf(end - start)
    return ngs.sqrt(ngs.InnerProduct(rest, rest) + 1e-6)


def _cf(vector: np.ndarray) -> ngs.CoefficientFunction:
    return ngs.CoefficientFunction(tuple(map(float, vector)))
