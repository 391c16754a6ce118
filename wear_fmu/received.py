"""How the wear unit learns of the forces, and of what lies between two communication points.

Running totals (``mesh_force_path`` along ``crank_path``) give the exact mean of a step, however
long it is and whoever divided it.  A plant that has none gives forces at the communication
points; between two of them they go along a straight line.  Which of the two is connected
shows from the totals: they have moved or they have not.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, scratch, state

# Beyond this turning of the cranks between two communication points forces that are only known there are guesswork:
# 5 % of their mean at 20 degrees (docs/decisions.md) [rad].
COARSE = math.pi / 9.0


def variables(sizes: Sizes) -> list[Variable]:
    contact, roller = sizes.over("disc", "pin"), sizes.over("disc", "crank", "roller")
    return [
        Variable("crank.path", "input", "rad", "turning of the cranks, either way added up", nominal=10.0),
        Variable("mesh.force_path", "input", "N.rad", "force between disc and pin added up along crank.path", **contact,
                 nominal=1000.0),
        Variable("roller.force_path", "input", "N.rad", "force on a roller added up along crank.path", **roller, nominal=1000.0),
        Variable("mesh.force", "input", "N", "force between disc and pin, where there is no mesh.force_path", **contact,
                 nominal=100.0),
        Variable("roller.force", "input", "N", "force on a roller, where there is no roller.force_path", **roller, nominal=100.0),
        local("coarse_steps", "1", "communication steps that left open where the wear was: the cranks turned by more than 20"
               " degrees, or to and fro by more than 1", integer=True, path="numerics.coarse_steps"),
        state("crank_path_before", "rad", "crank.path at the last step"),
        state("mesh_path_before", "N.rad", "mesh.force_path at the last step", **contact),
        state("roller_path_before", "N.rad", "roller_force_path at the last step", **roller),
        state("mesh_before", "N", "mesh_force at the last step", **contact),
        state("roller_before", "N", "roller_force at the last step", **roller),
        state("forces_given", "1", "whether there has been any force", integer=True, minimum=0, maximum=1),
        state("mesh_mean", "N", "mean of the force through the last step in which the cranks turned", **contact),
        state("roller_mean", "N", "mean of the force through the last step in which the cranks turned", **roller),
        scratch("mesh_trend", contact["shape"]), scratch("roller_trend", roller["shape"]), scratch("path"),
    ]


@kernel
def moved(total, before):
    """Whether any of a row of totals has changed."""
    for i in range(total.shape[0]):
        if total[i] != before[i]:
            return True
    return False


@kernel
def means(total, total_before, force, force_before, path, by_total, mean, trend):
    """Mean force and its change through the step for a row of contacts [N]; no contact is let pull."""
    for i in range(mean.shape[0]):
        mean[i] = 0.5 * (force[i] + force_before[i])
        if by_total:
            mean[i] = (total[i] - total_before[i]) / path
        mean[i] = max(0.0, mean[i])
        trend[i] = min(2.0 * mean[i], max(-2.0 * mean[i], force[i] - force_before[i]))


@kernel
def keep(now, before):
    for i in range(now.shape[0]):
        before[i] = now[i]


@kernel
def any_force(r):
    for d in range(r.mesh_force.shape[0]):
        for j in range(r.mesh_force.shape[1]):
            if r.mesh_before[d, j] != 0.0:
                return True
        for c in range(r.roller_force.shape[1]):
            for k in range(r.roller_force.shape[2]):
                if r.roller_before[d, c, k] != 0.0:
                    return True
    return False


@kernel
def receive(r):
    """Fill mean and trend of every contact's force, and the cranks' path through the step [rad]."""
    discs, cranks = r.roller_force.shape[:2]
    if not r.forces_given:
        # Who gives forces with the first step only means them from the start on.
        r.forces_given = 1
        if not any_force(r):
            keep_forces(r)
    turned = abs(r.crank_angle - r.crank_angle_before)
    by_mesh = by_roller = False
    for d in range(discs):
        by_mesh = by_mesh or moved(r.mesh_force_path[d], r.mesh_path_before[d])
        for c in range(cranks):
            by_roller = by_roller or moved(r.roller_force_path[d, c], r.roller_path_before[d, c])
    r.path = r.crank_path - r.crank_path_before
    if r.path < 0.0:
        # Totals that begin anew are those of another plant, or of one that was reset.
        by_mesh = by_roller = False
    if not (by_mesh or by_roller) or r.path == 0.0:
        r.path = turned
    if r.path <= 0.0:
        return
    for d in range(discs):
        means(r.mesh_force_path[d], r.mesh_path_before[d], r.mesh_force[d], r.mesh_before[d], r.path, by_mesh, r.mesh_mean[d],
              r.mesh_trend[d])
        for c in range(cranks):
            means(r.roller_force_path[d, c], r.roller_path_before[d, c], r.roller_force[d, c], r.roller_before[d, c], r.path,
                  by_roller, r.roller_mean[d, c], r.roller_trend[d, c])
    if r.acceleration > 0.0 and (turned > COARSE or r.path - turned > math.radians(1.0)):
        r.coarse_steps += 1


@kernel
def keep_forces(r):
    for d in range(r.mesh_force.shape[0]):
        keep(r.mesh_force[d], r.mesh_before[d])
        for c in range(r.roller_force.shape[1]):
            keep(r.roller_force[d, c], r.roller_before[d, c])


@kernel
def keep_received(r):
    """The next step begins with what this one ended with."""
    r.crank_path_before = r.crank_path
    r.crank_angle_before, r.output_angle_before, r.cage_angle_before = r.crank_angle, r.output_angle, r.cage_angle
    r.temperature_before = r.temperature
    keep_forces(r)
    for d in range(r.mesh_force.shape[0]):
        keep(r.mesh_force_path[d], r.mesh_path_before[d])
        for c in range(r.roller_force.shape[1]):
            keep(r.roller_force_path[d, c], r.roller_path_before[d, c])
