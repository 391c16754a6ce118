"""The wear unit: initialise it, step it through time.

In a step each contact moves from its old to its new place under its mean force and
takes off material between them.  All entry points take a one-element record array of
``wear_table`` and return a status code, 0 or a key of ``FAULTS``.
"""

import math

from fmu_src.effect import compose
from fmu_src.kernel import entry_point, kernel
from fmu_src.variables import Sizes, Variable, output, state
from wear_fmu.chosen_surfaces import GUARDS
from wear_fmu.contacts import look_ahead, publish_profiles, shortening
from wear_fmu.dimension import parameter
from wear_fmu.effects import HOOKS
from wear_fmu.kinematics import (
    PRINTED,
    equivalent_curvature,
    flank_arc_per_phase,
    printed_sliding_per_crank_angle,
    sliding_per_crank_angle,
)
from wear_fmu.received import keep_received, receive
from wear_fmu.sweeps import swept_part, wear_meshes, wear_raceways
from wear_fmu.wear_laws import mean_run_in_factor

effects = compose("wear_fmu.effects", HOOKS, GUARDS)
prepare_effects, advance_effects = effects.prepare, effects.advance
amplitudes_changed, keep_amplitudes = effects.amplitudes_changed, effects.keep_amplitudes

# A step is divided into at most so many parts.
MOST_SWEEPS = 100_000
# Whether the inputs are those of a step's end or of its beginning.
UNDECIDED, ON_TIME, LATE = 0, 1, 2

PRIMED, UNDERCUT, LONG_STEP, CAGE_ASTRAY, WORN_THROUGH = range(1, 6)
FAULTS = {
    PRIMED: "the trochoid has loops: crank.eccentricity {eccentricity:.6g} m times the number of pins must be less than"
    " pin.circle_radius {pin_circle_radius:.6g} m. Reduce crank.eccentricity or enlarge pin.circle_radius",
    UNDERCUT: "the profile is undercut: pin.radius {pin_radius:.6g} m exceeds the smallest convex radius of the"
    " centre curve. Reduce pin.radius or crank.eccentricity, or enlarge pin.circle_radius",
    LONG_STEP: "the cranks moved from {crank_angle_before:.6g} to {crank_angle:.6g} rad in one communication step,"
    " more than a unit can be meant to follow. Use a shorter communication step",
    CAGE_ASTRAY: "carrier or cages moved more than half a turn further than the cranks in one communication step, output.angle to"
    " {output_angle:.6g} rad, cage.angle to {cage_angle:.6g} rad: the wear cannot be placed. Connect crank.angle, output.angle and"
    " cage.angle of the same reducer",
    WORN_THROUGH: "worn through: a flank has lost more than pin.radius {pin_radius:.6g} m in depth, or a raceway more than the rollers' radius"
    " between inner_race.radius {inner_race_radius:.6g} m and outer_race.radius {outer_race_radius:.6g} m. Reduce acceleration"
    " {acceleration:.6g} or the wear coefficients; of wear.mesh_law and wear.race_law Janakiraman's are for steel alone",
}
CAUTIONS = {
    "coarse_steps": "between two communication points the cranks turned by more than 20 degrees, or to and fro by more than 1: where the"
    " wear was and under which forces is not known there, numerics.coarse_steps counts such steps. Use a shorter communication step",
}


def variables(sizes: Sizes) -> list[Variable]:
    contact, roller = sizes.over("disc", "pin"), sizes.over("disc", "crank", "roller")
    return [
        Variable("crank.angle", "input", "rad", "angle of the cranks in the housing"),
        Variable("crank.speed", "input", "rad/s", "speed of the cranks in the housing"),
        Variable("output.angle", "input", "rad", "angle of the carrier"),
        Variable("cage.angle", "input", "rad", "angle of the roller cages against the discs"),
        Variable("temperature", "input", "K", "temperature of the contacts", 293.15, minimum=200.0, maximum=500.0,
                 nominal=300.0, source="assumed: room temperature", path="heat.contact_temperature"),
        parameter("pins", "1", "whether the pins turn in their grooves and wear all round, or stand", 0,
                  choices=("turn", "stand"), source="assumed: they turn, which agrees with ten times less wear than"
                  " the disc", path="wear.pins"),
        parameter("pin_wear_share", "1", "wear of a pin over that of the flanks it meets; 0: pins do not wear", 1.0, 0.0, 100.0,
                  source="assumed: as hard as the discs, either loses the same area", path="wear.pin_share"),
        parameter("acceleration", "1", "wear, time and distance count this many times", 1.0, 0.0, tunable=True,
                  source="chosen by the master"),
        parameter("largest_sweep", "rad", "a communication step is divided so that no crank turns further in a part", math.radians(5.0), 1e-6,
                  1.0, source="assumed: 72 positions a turn", path="numerics.largest_sweep"),
        output("profile.angle", "rad", "crank angle that the profile errors hold for"),
        output("mesh.profile_error", "m", "what disc and pin lack at their contact", **contact, nominal=1e-6),
        output("roller.profile_error", "m", "what both raceways lack at a roller", **roller, nominal=1e-6),
        output("mesh.profile_slope", "m/rad", "change of mesh.profile_error as the cranks turn on", **contact, nominal=1e-4),
        output("roller.profile_slope", "m/rad", "change of roller.profile_error as the cranks turn on", **roller, nominal=1e-4),
        output("operating_time", "s", "time that the wear stands for", nominal=1e6, path="wear.operating_time"),
        output("crank_travel", "rad", "turning of the cranks that the wear stands for", nominal=1e9, path="wear.crank_travel"),
        state("effects_on", "1", "whether any effect acts on the wear coefficient", integer=True, minimum=0, maximum=1),
        state("standing", "1", "share of a pin's wear that stays in place"),
        state("crank_angle_before", "rad", "crank angle at the last step"),
        state("output_angle_before", "rad", "carrier angle at the last step"),
        state("cage_angle_before", "rad", "cage angle at the last step"),
        state("temperature_before", "K", "temperature at the last step"),
        state("profile_lead", "rad", "how far ahead of crank_angle the profile errors hold"),
        state("profile_reach", "rad", "turning through which their slopes are taken"),
        state("lateness", "1", "whether the inputs are those of a step's end (1) or beginning (2)", integer=True, minimum=0, maximum=2),
    ]


@kernel
def prepare(r):
    """Tables of one lobe: sliding length and arc of each bin, by Simpson's rule."""
    bins, lobes = r.arc.shape[0], r.mesh_force.shape[1] - 1
    k1 = shortening(r)
    width = 2.0 * math.pi / bins
    total = 0.0
    for i in range(bins):
        r.slide[i] = r.arc[i] = 0.0
        for part in range(3):
            phi = (i + 0.5 * part) * width
            weight = width * (4.0 if part == 1 else 1.0) / 6.0
            if r.sliding_form == PRINTED:
                slide = printed_sliding_per_crank_angle(phi, lobes, r.eccentricity, k1)
            else:
                slide = sliding_per_crank_angle(phi, lobes, r.pin_circle_radius, r.pin_radius, k1)
            r.slide[i] += weight * slide
            r.arc[i] += weight * flank_arc_per_phase(phi, lobes, r.pin_circle_radius, r.pin_radius, k1)
        r.slide_before[i] = total
        total += r.slide[i]


@kernel
def geometry_fault(r):
    """0, or the fault that makes this geometry impossible."""
    lobes, k1 = r.mesh_force.shape[1] - 1, shortening(r)
    if not k1 < 1.0:
        return PRIMED
    for i in range(721):
        if not equivalent_curvature(math.pi * i / 720.0, lobes, r.pin_circle_radius, r.pin_radius, k1) > 0.0:
            return UNDERCUT
    return 0


@kernel
def tune(r):
    """Effects by the amplitudes that are set now."""
    r.effects_on = 0
    r.standing = 1.0 if r.pins == 1 else 0.0
    prepare_effects(r)
    r.standing = min(1.0, r.standing)
    keep_amplitudes(r)


@entry_point
def initialise(records):
    """Check the parameters; new surfaces."""
    r = records[0]
    fault = geometry_fault(r)
    if fault != 0:
        return fault
    prepare(r)
    tune(r)
    keep_received(r)
    return 0


@kernel
def wear_part(r, count, i, duration):
    """Part ``i`` of ``count`` equal ones of a step of ``duration`` [s]."""
    swept_part(r, float(i) / count, (i + 1.0) / count)
    modulus = r.elastic_modulus / (1.0 - r.poisson_ratio * r.poisson_ratio)
    warmer = 0.5 * (r.temperature_before + r.temperature) - r.reference_temperature
    viscosity = r.pressure_viscosity * math.exp(-r.pressure_viscosity_slope * warmer)
    path, time = r.acceleration * r.path / count, r.acceleration * duration / count
    run_in = mean_run_in_factor(r.run_in_ratio, r.crank_travel, path, r.run_in_time * r.run_in_crank_speed)
    travelled, passed = r.crank_travel, r.operating_time
    if path > 0.0:
        # What effects take from travel and time they take at the part's middle.
        r.crank_travel, r.operating_time = travelled + 0.5 * path, passed + 0.5 * time
        after = (i + 0.5) / count - 0.5
        wear_meshes(r, modulus, viscosity, run_in, after)
        wear_raceways(r, modulus, viscosity, run_in, after)
    r.crank_travel, r.operating_time = travelled + path, passed + time
    advance_effects(r, time)


@kernel
def is_worn_through(r):
    """Whether more was taken off than what rolls or slides there is thick: no law of wear means that."""
    worn = False
    for d in range(r.flank_depth.shape[0]):
        if not r.flank_depth[d] < r.pin_radius:
            worn = True
        for c in range(r.inner_race_depth.shape[1]):
            if not max(r.inner_race_depth[d, c], r.outer_race_depth[d, c]) < 0.5 * (r.outer_race_radius - r.inner_race_radius):
                worn = True
    return worn


@entry_point
def take_off(records, duration):
    """What the contacts take off on their way to the present input angles."""
    r = records[0]
    turned = abs(r.crank_angle - r.crank_angle_before)
    if not turned <= MOST_SWEEPS * r.largest_sweep:
        return LONG_STEP
    carried, rolled = abs(r.output_angle - r.output_angle_before), abs(r.cage_angle - r.cage_angle_before)
    if not (carried <= math.pi + turned and rolled <= math.pi + turned):
        return CAGE_ASTRAY
    if is_worn_through(r):
        return WORN_THROUGH
    receive(r)
    if not r.path <= MOST_SWEEPS * r.largest_sweep:
        return LONG_STEP
    if amplitudes_changed(r):
        tune(r)
    count = max(1, math.ceil(turned / r.largest_sweep - 1e-3))
    for i in range(count):
        wear_part(r, count, i, duration)
    keep_received(r)
    return 0


@entry_point
def step(records, time, duration):
    """Wear of one communication step: contacts moved to the present input angles.

    One of no length wears nothing and reads the profiles where the present input angles have their contacts.
    """
    r = records[0]
    if duration == 0.0:
        look_ahead(r, r.profile_lead, r.profile_reach)
        return 0
    lateness = r.lateness
    if lateness == UNDECIDED and r.crank_speed * duration != 0.0:
        # Who exchanges at the steps' beginning hands over in the first one what was there before it.
        moved = abs(r.crank_angle - r.crank_angle_before)
        lateness = LATE if moved < 0.25 * abs(r.crank_speed) * duration else ON_TIME
    fault = take_off(records, duration)
    if fault != 0:
        return fault
    r.lateness = lateness
    turning = r.crank_speed * duration
    publish_profiles(r, turning if r.lateness == LATE else 0.0, r.crank_speed, turning)
    return 0
