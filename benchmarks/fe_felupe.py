"""One walk through the load steps of benchmarks/fe.py by FElupe; runs in FElupe's own environment, knows no myograph.

    python fe_felupe.py PROBLEM RESULT [--derivatives tensortrax jax] [--solver scipy pardiso]

The discrete muscle of src/myograph/mechanics in FElupe's words: triquadratic hexahedra with a continuous trilinear
pressure (a dual field that is not disconnected), 27 Gauss points, and FElupe's `newtonraphson`, which takes full steps.
The fibre, the shares of belly and tendon, the pre-stretch and the activation travel as state variables. FElupe's
tensortrax or JAX material differentiates the energy without pressure; p (J - 1) - p² / (2 K) is differentiated by hand,
as in FElupe's own mixed materials.
"""

import argparse
import json
import resource
import sys
import time
from types import SimpleNamespace

import felupe
import numpy as np
from fe_felupe_law import SITE, energy, sites
from felupe.math import cdya_il, det, dya, inv, transpose

TOLERANCE, MOST_STEPS = 1e-7, 26
SMALLEST_REACTION, PRESSURE_SCALE = 1.0, 0.01
"""Tolerance and scales of src/myograph/mechanics/newton.py, so that both sides stop at the same residual."""


def now():
    """Seconds of the wall's clock and of this process on its processor."""
    return np.array([time.perf_counter(), time.process_time()])


class Mixed(felupe.ConstitutiveMaterial):
    """Two-field material of displacement and pressure: an elastic one and p (J - 1) - p² / (2 K)."""

    def __init__(self, elastic, bulk):
        self.elastic, self.bulk = elastic, bulk
        self.x = [elastic.x[0], np.ones(1), elastic.x[-1]]

    def _gradient(self, x):
        F, p, site = x
        P = self.elastic.gradient([F, site])[0]
        return [P + p * transpose(inv(F, determinant=1.0)), det(F) - 1 - p / self.bulk, site]

    def _hessian(self, x):
        F, p, site = x
        J = det(F)
        inverse = transpose(inv(F, determinant=J))
        A = self.elastic.hessian([F, site])[0] + p * J * (dya(inverse, inverse) - cdya_il(inverse, inverse))
        return [A, J * inverse, np.full_like(p, -1 / self.bulk)]


class Clock(felupe.Plugin):
    """Seconds of the matrix's assembly, of the linear solves, and of the rest."""

    def __init__(self):
        self.seconds = {name: np.zeros(2) for name in ("matrix", "linear", "rest")}
        self.mark = now()

    def lap(self, name):
        """Count the time since the last lap to the name."""
        last, self.mark = self.mark, now()
        self.seconds[name] += self.mark - last

    def before_iteration(self, context, state):
        """All since the last linear solve."""
        self.lap("rest")

    def before_linear_solve(self, context, state):
        """The matrix is there."""
        self.lap("matrix")

    def after_linear_solve(self, context, state):
        """The unknowns are there."""
        self.lap("linear")


class Muscle:
    """FElupe's body of one problem."""

    def __init__(self, problem, derivatives):
        self.problem, self.law = problem, json.loads(str(problem["law"]))
        element = felupe.TriQuadraticHexahedron()
        local = ((element.points + 1) @ (1, 3, 9)).astype(int)
        vertices = np.unique(problem["cells"][:, local[:8]])
        old = np.concatenate([vertices, np.setdiff1d(np.arange(len(problem["points"])), vertices)])
        self.number = np.argsort(old)
        mesh = felupe.Mesh(problem["points"][old], self.number[problem["cells"][:, local]], "hexahedron27")
        region = felupe.RegionTriQuadraticHexahedron(mesh)
        fields = [felupe.Field(region, dim=3), felupe.FieldDual(region, disconnect=False)]
        self.field, self.forces = felupe.FieldContainer(fields), fields[0].values.size
        distances = np.linalg.norm(problem["places"][:, None] - region.quadrature.points[None], axis=2)
        self._order = distances.argmin(axis=0)
        fixed, self.moved = (self._unknowns(problem[end]) for end in ("origin", "insertion"))
        self.held = np.concatenate([fixed, self.moved])
        self.free = np.setdiff1d(np.arange(sum(self.field.fieldsizes)), self.held)
        material = Mixed(elastic_material(self.law, derivatives), self.law["belly"]["bulk"])
        self.body = felupe.SolidBody(material, self.field, statevars=self.site(0.0, 0.0))

    def _unknowns(self, nodes):
        return (3 * self.number[nodes][:, None] + np.arange(3)).ravel()

    def site(self, ramp, activation):
        """State variables at a load, in FElupe's order of integration points."""
        values = sites(self.problem, self.law["tissue"], ramp, activation)
        return np.ascontiguousarray(values[:, :, self._order].transpose(0, 2, 1))

    def check(self, dx, f, ftol, dof1, dof0, **_):
        """Our criterion in place of FElupe's: size of the step, residual over reaction, and whether that will do."""
        size = np.hypot(np.linalg.norm(f[dof1[dof1 < self.forces]]), PRESSURE_SCALE * np.linalg.norm(f[self.forces :]))
        size /= max(np.linalg.norm(f[dof0]), SMALLEST_REACTION)
        return float(np.linalg.norm(dx)), float(size), bool(size <= ftol)

    def step(self, load, place, solver, clock):
        """Solve one load step; the result of FElupe's Newton."""
        self.body.results.statevars = self.site(*load[:2])
        prescribed = np.concatenate([np.zeros(self.held.size - self.moved.size), place.ravel()])
        unknowns = {"dof1": self.free, "dof0": self.held, "ext0": prescribed}
        stop = {"check": self.check, "tol": TOLERANCE, "maxiter": MOST_STEPS, "verbose": False}
        result = felupe.newtonraphson(self.field, items=[self.body], solver=solver, plugins=[clock], **unknowns, **stop)
        self.field = result.x
        return result


def elastic_material(law, derivatives):
    """FElupe's material of the energy without pressure, differentiated by tensortrax or JAX."""
    if derivatives == "jax":
        import jax
        import jax.numpy as jnp
        from felupe.constitution import jax as materials

        jax.config.update("jax_enable_x64", True)
        f = SimpleNamespace(sqrt=jnp.sqrt, log=jnp.log, erf=jax.scipy.special.erf, choose=jnp.where)
    else:
        import tensortrax.math as tm
        from felupe.constitution import tensortrax as materials

        f = SimpleNamespace(sqrt=tm.sqrt, log=tm.log, erf=tm.special.erf, choose=masked)
    return materials.Hyperelastic(lambda C, site: (energy(C, site, law, f), site), nstatevars=SITE)


def masked(condition, then, otherwise):
    """Tensortrax has no `where`: a mask of ones and zeros."""
    mask = np.where(condition, 1.0, 0.0)
    return mask * then + (1 - mask) * otherwise


def linear_solver(name):
    """SuperLU of SciPy, FElupe's default, or MKL's Pardiso told that the matrix is symmetric (twice as fast so)."""
    if name == "scipy":
        from scipy.sparse.linalg import spsolve

        return spsolve
    import pypardiso
    from scipy.sparse import triu

    pardiso = pypardiso.PyPardisoSolver(mtype=-2)
    return lambda A, b: pardiso.solve(triu(A, format="csr"), b)


def walk(problem, derivatives, solver):
    """Go through all loads: where it ended, and what it took."""
    started = now()
    muscle, solve = Muscle(problem, derivatives), linear_solver(solver)
    muscle.body.assemble.vector(muscle.field)
    muscle.body.assemble.matrix(muscle.field)  # here JAX compiles: part of the preparation
    clock, steps = Clock(), 0
    prepared = clock.mark
    for load, place in zip(problem["loads"], problem["moved"], strict=True):
        result = muscle.step(load, place, solve, clock)
        steps += result.iterations
    clock.lap("rest")
    cost = {"setup": prepared - started, "walk": clock.mark - prepared, **clock.seconds, "newton_steps": steps}
    positions = problem["points"] + muscle.field[0].values[muscle.number]
    moment = -float(result.fun[muscle.moved] @ problem["rate"].ravel())
    return {"positions": positions, "moment": moment}, cost


def main():
    """Solve, write the answer, say what it took as JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem")
    parser.add_argument("result")
    parser.add_argument("--derivatives", choices=("tensortrax", "jax"), default="tensortrax")
    parser.add_argument("--solver", choices=("scipy", "pardiso"), default="scipy")
    options = parser.parse_args()
    with np.load(options.problem, allow_pickle=False) as file:
        problem = dict(file)
    answer, cost = walk(problem, options.derivatives, options.solver)
    np.savez(options.result, **answer)
    cost["memory_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    sys.stdout.write(json.dumps(cost, default=list) + "\n")


if __name__ == "__main__":
    main()
