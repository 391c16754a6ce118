"""Natural frequencies and mode shapes about an operating point.

The tangent of the moving plant at equilibrium under load is its stiffness matrix, the
part that goes with velocities its damping matrix.  The input is held, or free: then the sun
turns with its inertia.  Joints that are rigid in statics have a very small compliance in motion;
their modes lie far above all others and are left out.  Without load bearings float in their
clearance: what floats has no frequency.
"""

from collections.abc import Sequence
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
# Below this [Hz] nothing holds the bodies: they float in their clearance, or turn freely.
FLOATING = 15.0
# A second group of bodies is named beside the first from this share of the kinetic energy on.
SECOND = 0.2
# Beyond this likeness of two bodies' shapes they move together, below its negative against each other.
ALIKE = 0.5


@dataclass(frozen=True)
class Mode:
    """One mode: frequency, damping ratio, what moves, and the shares of its kinetic energy by body, and by what a group of bodies does (``parts``)."""

    frequency_Hz: float
    damping_ratio: float
    moves: str
    energy_share: dict[str, float]
    parts: dict[str, float]
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


def at_rated_motion(reducer: Reducer, settings: list[Setting]) -> InProcess:
    """The plant in motion at its first equilibrium."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    plant.set("fidelity", 1)
    plant.exit_initialisation()
    return plant


def modes(reducer: Reducer, settings: list[Setting], held: bool = True) -> list[Mode]:
    """Modes, lowest first, with the input ``held`` or free to turn with its inertia."""
    mass, stiffness, damping = matrices(at_rated_motion(reducer, settings).records)
    names = body_names(reducer)
    free = [i for i, name in enumerate(names) if not (held and name == "sun turning")]
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
        named = {names[i]: float(x) for i, x in zip(free, shape)}
        weighed = {names[i]: float(x) for i, x in zip(free, np.sqrt(mass[free]) * shape)}
        frequency = float(omega / (2.0 * np.pi))
        floats, groups = frequency < FLOATING, groups_of(weighed, reducer)
        found.append(Mode(
            frequency, 0.0 if floats else float(loss / (2.0 * omega)), moving(groups) + (", held by nothing" if floats else ""), shares,
            energies(groups), named,
        ))  # fmt: skip
    return found


def groups_of(weighed: dict[str, float], reducer: Reducer) -> dict[str, list[list[float]]]:
    """What the bodies of each group do in a mode, ``weighed`` with the roots of their masses."""
    t = reducer.topology
    groups: dict[str, list[list[float]]] = {}
    for kind, count in (("disc", t.discs), ("crank", t.cranks)):
        bodies = [f"{kind} {k + 1}" for k in range(count)]
        groups[f"{kind}s shift"] = [[weighed[f"{b} x"], weighed[f"{b} y"]] for b in bodies]
        groups[f"{kind}s turn"] = [[weighed[f"{b} turning"]] for b in bodies]
    groups["carrier shifts"] = [[weighed["carrier x"], weighed["carrier y"]]]
    groups |= {f"{one} turns": [[weighed[f"{one} turning"]]] for one in ("carrier", "ring", "sun", "load") if f"{one} turning" in weighed}
    return groups


def energies(groups: dict[str, list[list[float]]]) -> dict[str, float]:
    """Share of each group in the kinetic energy."""
    return {name: float(np.sum(np.square(parts))) for name, parts in groups.items()}


def moving(groups: dict[str, list[list[float]]]) -> str:
    """What a mode is called: the groups of bodies with most of the kinetic energy, and how those of a group move."""
    energy = energies(groups)
    order = sorted(energy, key=lambda name: -energy[name])
    chosen = order[: 2 if energy[order[1]] > SECOND else 1]
    return ", ".join(f"{name}{together(groups[name])}" for name in chosen)


def together(parts: Sequence[Sequence[float]]) -> str:
    """How two or more bodies move: together, against each other, or neither."""
    if len(parts) < 2:
        return ""
    a = np.array(parts)
    size = np.linalg.norm(a, axis=1)
    pairs = [(i, k) for i in range(len(a)) for k in range(i)]
    likeness = [float(a[i] @ a[k] / max(size[i] * size[k], 1e-300)) for i, k in pairs]
    if min(likeness) > ALIKE:
        return " together"
    return " against each other" if min(likeness) < -ALIKE else ""
