"""Contact forces added up along the cranks' path: what the wear unit takes off is made of them.

    path = integral of |d crank angle|,    force path = integral of F |d crank angle|    [rad, N rad]

Running totals add up exactly: over any communication step the difference of two totals is
the force's mean times the turning, however the step was divided.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, output, state
from rv_plant.contact_arrays import copy_contacts


def variables(sizes: Sizes) -> list[Variable]:
    contact, roller = sizes.over("disc", "pin"), sizes.over("disc", "crank", "roller")
    return [
        output("crank.path", "rad", "turning of the cranks in the housing, either way added up", nominal=10.0),
        output("mesh.force_path", "N.rad", "force between disc and pin added up along crank.path", **contact, nominal=1000.0),
        output("roller.force_path", "N.rad", "force on a roller added up along crank.path", **roller, nominal=1000.0),
        state("mesh_force_before", "N", "force at the last point of crank.path", **contact),
        state("roller_force_before", "N", "force at the last point of crank.path", **roller),
    ]


@kernel
def start_force_paths(r):
    """From the present forces on."""
    copy_contacts(r.mesh_force_now, r.roller_force_now, r.mesh_force_before, r.roller_force_before)


@kernel
def add_force_paths(r, turned):
    """The cranks turned by ``turned`` [rad] under forces between those before and those now: trapezoidal, second order."""
    path = abs(turned)
    r.crank_path += path
    discs, cranks, rollers = r.roller_force.shape
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            r.mesh_force_path[d, j] += 0.5 * path * (r.mesh_force_before[d, j] + r.mesh_force_now[d, j])
            r.mesh_force_before[d, j] = r.mesh_force_now[d, j]
        for c in range(cranks):
            for k in range(rollers):
                r.roller_force_path[d, c, k] += 0.5 * path * (r.roller_force_before[d, c, k] + r.roller_force_now[d, c, k])
                r.roller_force_before[d, c, k] = r.roller_force_now[d, c, k]
