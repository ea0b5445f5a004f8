"""Fibre direction from a Laplace solution: the unit gradient of a potential that runs from origin to insertion."""

import ngsolve as ngs

from myograph.mechanics.space import NodalSpace


def fibre_direction(space: NodalSpace) -> ngs.CoefficientFunction:
    """Unit fibre direction in the reference body; no flux through the skin, so that fibres run along it."""
    potential_space = ngs.H1(space.mesh, order=2, dirichlet="origin|insertion")
    trial, test = potential_space.TnT()
    potential = ngs.GridFunction(potential_space)
    potential.Set(ngs.CoefficientFunction(1.0), definedon=space.mesh.Boundaries("insertion"))
    stiffness = ngs.BilinearForm(ngs.grad(trial) * ngs.grad(test) * ngs.dx).Assemble()
    inverse = stiffness.mat.Inverse(potential_space.FreeDofs(), "sparsecholesky")
    potential.vec.data -= inverse * (stiffness.mat * potential.vec).Evaluate()
    gradient = ngs.grad(potential)
    return gradient / ngs.Norm(gradient)
