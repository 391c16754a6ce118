"""Profile errors between two communication points.

The wear unit says what the surfaces lack at the contacts where the cranks stood at
``profile_angle``, and how that changes as they turn on:

    error(angle) = given + slope (angle - profile_angle)

Through a step the errors go along the straight line from those of the step's start to
those where the step is expected to end: jumps would strike bodies in motion.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, scratch, state
from rv_plant.contact_arrays import copy_contacts
from rv_plant.faults import QUASI_STATIC


def variables(sizes: Sizes) -> list[Variable]:
    contact, roller = sizes.over("disc", "pin"), sizes.over("disc", "crank", "roller")
    return [
        Variable("profile.angle", "input", "rad", "crank angle that the profile errors hold for; 0: wherever the cranks stand"),
        Variable("mesh.profile_slope", "input", "m/rad", "change of mesh.profile_error as the cranks turn on", **contact, nominal=1e-4),
        Variable("roller.profile_slope", "input", "m/rad", "change of roller.profile_error as the cranks turn on", **roller,
                 nominal=1e-4),
        state("mesh_error_start", "m", "profile error at the last communication point", **contact),
        state("roller_error_start", "m", "profile error at the last communication point", **roller),
        scratch("mesh_error_given", contact["shape"]), scratch("roller_error_given", roller["shape"]),
        scratch("mesh_error_end", contact["shape"]), scratch("roller_error_end", roller["shape"]),
    ]


@kernel
def start_profiles(r, turning):
    """Keep the errors as given; work out those at the end of a step in which the cranks turn by ``turning`` [rad].

    At rest the step also starts from the given ones; bodies in motion from those that they were left with.
    """
    copy_contacts(r.mesh_profile_error, r.roller_profile_error, r.mesh_error_given, r.roller_error_given)
    late = r.crank_angle - r.profile_angle if r.profile_angle != 0.0 else 0.0
    predict(r, late + turning, r.mesh_error_end, r.roller_error_end)
    if r.fidelity == QUASI_STATIC:
        predict(r, late, r.mesh_error_start, r.roller_error_start)


@kernel
def predict(r, ahead, mesh_error, roller_error):
    """Errors where the cranks have turned by ``ahead`` [rad] beyond the angle that the given ones hold for."""
    discs, cranks, rollers = r.roller_force.shape
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            mesh_error[d, j] = r.mesh_profile_error[d, j] + ahead * r.mesh_profile_slope[d, j]
        for c in range(cranks):
            for k in range(rollers):
                roller_error[d, c, k] = r.roller_profile_error[d, c, k] + ahead * r.roller_profile_slope[d, c, k]


@kernel
def take_profiles(r, share):
    """Profile errors at a share of the way through the step."""
    discs, cranks, rollers = r.roller_force.shape
    for d in range(discs):
        for j in range(r.mesh_force.shape[1]):
            start, end = r.mesh_error_start[d, j], r.mesh_error_end[d, j]
            r.mesh_profile_error[d, j] = end if share == 1.0 else start + share * (end - start)
        for c in range(cranks):
            for k in range(rollers):
                start, end = r.roller_error_start[d, c, k], r.roller_error_end[d, c, k]
                r.roller_profile_error[d, c, k] = end if share == 1.0 else start + share * (end - start)


@kernel
def end_profiles(r):
    """The inputs as they were given; the next step starts from the errors of this one's end."""
    copy_contacts(r.mesh_error_given, r.roller_error_given, r.mesh_profile_error, r.roller_profile_error)
    copy_contacts(r.mesh_error_end, r.roller_error_end, r.mesh_error_start, r.roller_error_start)
