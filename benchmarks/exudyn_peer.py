"""Exudyn, a general multibody package, as a peer of the plant's motion.

Its own contacts cannot express trochoid flanks against pins.  It therefore gets the plant's equations
of motion as one object with user functions for the generalised forces and, where they are ours,
for the Jacobian, and integrates them with its implicit generalised-alpha method of fixed steps.
Its explicit methods are out of reach: the dampers of the stiffest joints have eigenvalues of 5e9 1/s.
"""

from itertools import product
from typing import Any, Protocol

import numpy as np

from benchmarks.numba_peer import njit
from fmu_src.arrays import Floats
from rv_plant.dynamics import assemble_motion

# Steps from one communication point to the next, relative tolerance of Newton's method, whether its matrix
# is kept while it converges, and spectral radius.
Setting = tuple[int, float, bool, float]
LADDER: tuple[Setting, ...] = tuple(product((2, 3, 4, 6, 8), (1e-2, 3e-3, 1e-3), (True, False), (0.5, 0.8)))
# Differentiating numerically does not pay at every iteration.
SLOW_LADDER: tuple[Setting, ...] = tuple(product((2, 3, 4, 6, 8), (1e-2, 1e-3), (True,), (0.8,)))


@njit
def forces(records: np.ndarray, q: Floats, v: Floats, cage: float, out: Floats) -> None:
    """Generalised forces, as Exudyn adds them on the right."""
    r = records[0]
    r.q[:], r.v[:], r.cage = q, v, cage
    assemble_motion(r, 1.0)
    out[:] = -r.residual_vector


@njit
def tangent(
    records: np.ndarray, q: Floats, v: Floats, cage: float, stiffness: float, damping: float, out: Floats
) -> None:
    """``stiffness`` times K plus ``damping`` times D: one assembly gives K + rate D."""
    r = records[0]
    r.q[:], r.v[:], r.cage = q, v, cage
    assemble_motion(r, damping / stiffness)
    for i in range(len(q)):
        for j in range(len(q)):
            out[i, j] = stiffness * r.tangent[min(i, j), max(i, j)]


class System(Protocol):
    """What is asked of a problem (``motion.Problem``)."""

    n: int
    records: np.ndarray
    start: Floats
    times: Floats
    calls: int

    def numpy(self, _: float, y: Floats) -> Floats: ...


class ExudynPlant:
    """The problem as a system of Exudyn, built once; each run starts from the same state."""

    def __init__(self, problem: System, numpy: bool):
        import exudyn as exu
        from exudyn.itemInterface import NodeGenericODE2, ObjectGenericODE2, SensorNode

        # Runs that do not converge are part of the ladder and need no message.
        exu.config.printToConsole = False
        self.exu, self.problem = exu, problem
        n, records = problem.n, problem.records
        r, y = records[0], problem.start.copy()
        carrier = 3 * r["roller_force"].shape[0]
        # The cage's speed is a constant combination of two speeds, so its angle needs no equation of its own.
        share = r["inner_race_radius"] / (r["inner_race_radius"] + r["outer_race_radius"])
        self.rolled = np.zeros(n)
        self.rolled[carrier + 5], self.rolled[carrier] = share, -share
        self.cage = y[2 * n] - self.rolled @ y[:n]
        mass, out, matrix = r["mass"].copy(), np.zeros(n), np.zeros((n, n))

        def cage(q: Floats) -> float:
            return float(self.cage + share * (q[carrier + 5] - q[carrier]))

        def ours(mbs: object, t: float, item: int, q: Floats, v: Floats) -> Floats:
            problem.calls += 1
            forces(records, np.asarray(q), np.asarray(v), cage(q), out)
            return out

        def jacobian(mbs: object, t: float, item: int, q: Floats, v: Floats, stiffness: float, damping: float) -> Any:
            problem.calls += 1
            tangent(records, np.asarray(q), np.asarray(v), cage(q), stiffness, damping, matrix)
            return exu.MatrixContainer(matrix)

        def theirs(mbs: object, t: float, item: int, q: Floats, v: Floats) -> Floats:
            y[:n], y[n : 2 * n], y[2 * n] = q, v, cage(q)
            found: Floats = mass * problem.numpy(t, y)[n : 2 * n]
            return found

        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        node = self.system.AddNode(NodeGenericODE2(
            referenceCoordinates=np.zeros(n), initialCoordinates=y[:n], initialCoordinates_t=y[n : 2 * n], numberOfODE2Coordinates=n))
        self.system.AddObject(ObjectGenericODE2(
            nodeNumbers=[node], massMatrix=np.diag(mass), forceUserFunction=theirs if numpy else ours,
            jacobianUserFunction=0 if numpy else jacobian))
        kinds = exu.OutputVariableType
        self.sensors = [self.system.AddSensor(SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind))
                        for kind in (kinds.Coordinates, kinds.Coordinates_t)]
        self.system.Assemble()

    def states(self, setting: Setting) -> Floats | None:
        """States at the communication points, or None."""
        steps, tolerance, kept, radius = setting
        exu, times = self.exu, self.problem.times
        settings = exu.SimulationSettings()
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = times[0] / steps
        settings.linearSolver.solverType = exu.LinearSolverType.EXUdense
        time = settings.timeIntegration
        time.endTime, time.numberOfSteps, time.adaptiveStep, time.verboseMode = times[-1], steps * len(times), False, 0
        time.generalizedAlpha.spectralRadius = radius
        time.newton.useModifiedNewton, time.newton.relativeTolerance = kept, tolerance
        # The residual is in N and N m, of forces of some kN.
        time.newton.absoluteTolerance = 1e-6
        try:
            self.system.SolveDynamic(settings, showHints=False)
        except exu.SolverError:
            return None
        q, v = (self.system.GetSensorStoredData(sensor)[steps::steps, 1:] for sensor in self.sensors)
        return np.hstack([q, v, (self.cage + q @ self.rolled)[:, None]])
