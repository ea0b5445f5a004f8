"""The same muscle as swept hexahedra and as tetrahedra inside its skin: the same moments and the same belly."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.anatomy.model import Contact
from myograph.mechanics.muscle import FiniteElementMuscle
from myograph.mechanics.tetrahedra import surface_mesh
from myograph.mesh.presets import muscle_mesh
from myograph.mesh.surface import Attachment, Attachments, read_surface, skin_of
from myograph.mesh.sweep import Resolution
from myograph.units import newton_metres, radians

ROOT = Path(os.environ.get("MYOGRAPH_REFERENCE_DATA", Path(__file__).parents[3] / "shared" / "data")) / "opendihu"
STATES = ((0.0, 60.7), (0.6, 75.0))


def _tetrahedra(arm, name, size):
    """Tetrahedra inside the skin of a finely swept mesh, held at the same two faces."""
    swept = muscle_mesh(arm, name, Resolution(core=6, rings=1, along=44))

    def attachment(end):
        centre = swept.end_centre(end)
        radius = np.linalg.norm(swept.points[swept.end_nodes(end)] - centre, axis=1).max()
        x, y, z = centre.tolist()
        return (Attachment((x, y, z), 1.05 * float(radius)),)

    return surface_mesh(skin_of(swept), Attachments(attachment("origin"), attachment("insertion")), size, name)


def _belly(mesh, positions):
    """Centre [mm] and three half-axes [mm] of the middle of the muscle."""
    shape = mesh.element.values(mesh.element.places)
    along, weight = (mesh.along[mesh.cells] @ shape.T).ravel(), mesh.element.volumes(mesh.points, mesh.cells).ravel()
    weight = np.where(np.abs(along - 0.55) < 0.2, weight, 0.0) / weight.sum()
    places = np.einsum("qn,cna->cqa", shape, positions[mesh.cells]).reshape(-1, 3)
    centre = weight @ places / weight.sum()
    spread = np.einsum("p,pa,pb->ab", weight, places - centre, places - centre) / weight.sum()
    return centre, np.sqrt(np.linalg.eigvalsh(spread))


def _solved(arm, name, mesh):
    """Moments [N·m] at the states, and the belly at the last."""
    muscle = FiniteElementMuscle(arm, name, mesh=mesh)
    states = [muscle.solve(activation, radians(angle)) for activation, angle in STATES]
    return np.array([newton_metres(s.moment) for s in states]), _belly(mesh, states[-1].fields["position"]), states[-1]


@pytest.mark.exhaustive
def test_tetrahedra_and_hexahedra_agree_the_better_the_finer():
    """The anconeus, relaxed and active, at another angle."""
    arm, name = built_in_arm(), "anconeus"
    moments, belly, _ = _solved(arm, name, muscle_mesh(arm, name, Resolution(core=1, rings=1, along=20)))
    coarse, fine = (_solved(arm, name, _tetrahedra(arm, name, size)) for size in (12.0, 7.0))
    errors = [np.abs(found[0] / moments - 1).max() for found in (coarse, fine)]
    assert errors[1] < errors[0] < 0.02
    assert fine[1][0] == pytest.approx(belly[0], abs=1.0)
    assert fine[1][1] == pytest.approx(belly[1], rel=0.03)
    assert fine[2].fields["cauchy_stress"].shape == (len(fine[2].fields["position"]), 6)


@pytest.mark.exhaustive
@pytest.mark.reference
@pytest.mark.skipif(not ROOT.exists(), reason="the reference data are not here; set MYOGRAPH_REFERENCE_DATA")
def test_the_reference_biceps_goes_the_whole_way():
    """A real muscle with two heads, in the place of the built-in biceps: free of contacts, with tendons as long as its
    own, its height that of the arm."""
    surface = read_surface(ROOT / "biceps_full.stl")
    surface = replace(surface, points=surface.points - np.array([0.0, 0.0, 637.7]))
    heads = (Attachment((128.0, 174.5, -293.7), 10.0), Attachment((139.0, 184.5, -297.7), 10.0))
    mesh = surface_mesh(surface, Attachments(heads, (Attachment((46.0, 147.0, -637.2), 12.0),)), 20.0, "biceps")
    assert mesh.volume() == pytest.approx(320e3, rel=0.01)
    arm = built_in_arm()
    tendons = arm.muscles["biceps"].tendons.model_copy(update={"origin": 100.0, "insertion": 75.0})
    biceps = arm.muscles["biceps"].model_copy(update={"contact": Contact(), "tendons": tendons})
    arm = arm.model_copy(update={"muscles": {**arm.muscles, "biceps": biceps}})
    muscle = FiniteElementMuscle(arm, "biceps", mesh=mesh)
    relaxed, active = (muscle.solve(activation, arm.reference_angle) for activation in (0.0, 0.3))
    assert 2 < newton_metres(relaxed.moment) < newton_metres(active.moment) < 15
    assert abs(active.soundness.volume_change) < 1e-3
    assert active.soundness.smallest_jacobian > 0.1
