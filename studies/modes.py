"""Natural frequencies and mode shapes about an operating point.

The tangent of the moving plant at equilibrium under load is its stiffness matrix, the
part that goes with velocities its damping matrix.  The input is held.  Joints that are
rigid in statics have a very small compliance in motion; their modes lie far above all
others and are left out.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from fmu_src.arrays import Floats, Records
from orchestrator.component import InProcess
from orchestrator.settings import Setting, apply
from reducers.reducer import Reducer
from rv_plant.motion import linearise

# Modes above this belong to joints that stand for rigid [Hz].
HIGHEST = 5e4


@dataclass(frozen=True)
class Mode:
    """One mode: frequency, damping ratio, and the share of each body in its kinetic energy."""

    frequency_Hz: float
    damping_ratio: float
    energy_share: dict[str, float]
    shape: dict[str, float]


def body_names(reducer: Reducer) -> list[str]:
    """One name per coordinate, as in rv_plant.dynamics."""
    t = reducer.topology
    names = [f"disc {d + 1} {axis}" for d in range(t.discs) for axis in ("x", "y", "turning")]
    names += ["carrier turning", "carrier x", "carrier y"]
    names += [f"crank {c + 1} {axis}" for c in range(t.cranks) for axis in ("x", "y", "turning")]
    return [*names, "ring turning", "sun turning", "load turning"]


def matrices(record: Records) -> tuple[Floats, Floats, Floats]:
    """(mass diagonal, stiffness, damping) from the record of an initialised plant with fidelity dynamic."""

    def tangent(rate_weight: float) -> Floats:
        linearise(record, rate_weight)
        upper: Floats = np.triu(record["tangent"][0])
        return upper + np.triu(upper, 1).T

    # The tangent is linear in the weight; both weights let the damping forces of the motion act.
    damping = (tangent(2e3) - tangent(1e3)) / 1e3
    return record["mass"][0].copy(), tangent(1e3) - 1e3 * damping, damping


def modes(reducer: Reducer, settings: list[Setting]) -> list[Mode]:
    """Modes with the input held, lowest first."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    plant.set("fidelity", 1)
    plant.exit_initialisation()
    mass, stiffness, damping = matrices(plant.records)
    names = body_names(reducer)
    free = [i for i, name in enumerate(names) if name != "sun turning"]
    square, shapes = eigh(stiffness[np.ix_(free, free)], np.diag(mass[free]))
    found = []
    for value, shape in zip(square, shapes.T):
        omega = np.sqrt(max(value, 0.0))
        if omega / (2.0 * np.pi) > HIGHEST:
            continue
        # Shapes are scaled to unit modal mass.
        loss = shape @ damping[np.ix_(free, free)] @ shape
        shares: dict[str, float] = {}
        for i, part in zip(free, mass[free] * shape**2):
            body = names[i].rsplit(" ", 1)[0]
            shares[body] = shares.get(body, 0.0) + float(part)
        found.append(Mode(
            float(omega / (2.0 * np.pi)), float(loss / (2.0 * omega)) if omega > 0.0 else 0.0, shares,
            {names[i]: float(x) for i, x in zip(free, shape)},
        ))  # fmt: skip
    return found
