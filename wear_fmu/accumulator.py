"""The wear unit: initialise it, step it through time.

In a step each contact moves from its old to its new place under its mean force and
takes off material between them.  All entry points take a one-element record array of
``wear_table`` and return a status code, 0 or a key of ``FAULTS``.
"""

import math

from fmu_src.effect import compose
from fmu_src.kernel import entry_point, kernel
from fmu_src.variables import Sizes, Variable, output, state
from wear_fmu.chosen_surfaces import FLANK, GUARDS, INNER, OUTER, PIN
from wear_fmu.dimension import parameter
from wear_fmu.effects import HOOKS
from wear_fmu.kinematics import (
    PRINTED,
    equivalent_curvature,
    flank_arc_per_phase,
    printed_sliding_per_crank_angle,
    sliding_per_crank_angle,
)
from wear_fmu.places import first_roller, flank_position, pin_position, shortening
from wear_fmu.surfaces import (
    add_flank_pass,
    add_footprint,
    add_pass,
    interpolate_closed,
    interpolate_open,
)
from wear_fmu.wear_laws import run_in_factor, wear_coefficient

effects = compose("wear_fmu.effects", HOOKS, GUARDS)
prepare_effects, advance_effects, effect_factor = effects.prepare, effects.advance, effects.factor

PRIMED, UNDERCUT, LONG_STEP, CAGE_ASTRAY = range(1, 5)
FAULTS = {
    PRIMED: "the trochoid has loops: eccentricity {eccentricity:.6g} m times the number of pins must be less than"
    " pin_circle_radius {pin_circle_radius:.6g} m. Reduce eccentricity or enlarge pin_circle_radius",
    UNDERCUT: "the profile is undercut: pin_radius {pin_radius:.6g} m exceeds the smallest convex radius of the"
    " centre curve. Reduce pin_radius or eccentricity, or enlarge pin_circle_radius",
    LONG_STEP: "the cranks moved from {crank_angle_before:.6g} to {crank_angle:.6g} rad in one communication step,"
    " more than half a turn: the wear cannot be placed. Use a shorter communication step",
    CAGE_ASTRAY: "carrier or cages moved more than half a turn in one communication step, output_angle to"
    " {output_angle:.6g} rad, cage_angle to {cage_angle:.6g} rad: the wear cannot be placed. Connect both angles, or use"
    " a shorter communication step",
}


def variables(sizes: Sizes) -> list[Variable]:
    contact, roller = sizes.over("disc", "pin"), sizes.over("disc", "crank", "roller")
    return [
        Variable("crank_angle", "input", "rad", "angle of the cranks in the housing"),
        Variable("crank_speed", "input", "rad/s", "speed of the cranks in the housing"),
        Variable("output_angle", "input", "rad", "angle of the carrier"),
        Variable("cage_angle", "input", "rad", "angle of the roller cages against the discs"),
        Variable("temperature", "input", "K", "temperature of the contacts", 293.15, minimum=200.0, maximum=500.0,
                 nominal=300.0, source="assumed: room temperature"),
        Variable("mesh_force", "input", "N", "force between disc and pin, mean over the communication step",
                 **contact, nominal=100.0),
        Variable("roller_force", "input", "N", "force on a roller, mean over the communication step",
                 **roller, nominal=100.0),
        parameter("pins", "1", "whether the pins turn in their grooves and wear all round, or stand", 0,
                  choices=("turn", "stand"), source="assumed: they turn, which agrees with ten times less wear than"
                  " the disc"),
        parameter("pin_wear_share", "1", "wear of a pin over that of the flanks it meets; 0: pins do not wear", 1.0, 0.0, 100.0,
                  source="assumed: as hard as the discs, either loses the same area"),
        parameter("acceleration", "1", "wear, time and distance count this many times", 1.0, 0.0, tunable=True,
                  source="chosen by the master"),
        parameter("contact_lead", "1", "profile errors are given for the contact this many communication steps"
                  " ahead; 0 gives the present contact", 1.0, 0.0, 10.0, tunable=True,
                  source="1 makes the exchange of plant and wear second order in the step"),
        output("mesh_profile_error", "m", "what disc and pin lack at their contact", **contact, nominal=1e-6),
        output("roller_profile_error", "m", "what both raceways lack at a roller", **roller, nominal=1e-6),
        output("operating_time", "s", "time that the wear stands for", nominal=1e6),
        output("crank_travel", "rad", "turning of the cranks that the wear stands for", nominal=1e9),
        state("effects_on", "1", "whether any effect acts on the wear coefficient", integer=True),
        state("standing", "1", "share of a pin's wear that stays in place"),
        state("crank_angle_before", "rad", "crank angle at the last step"),
        state("output_angle_before", "rad", "carrier angle at the last step"),
        state("cage_angle_before", "rad", "cage angle at the last step"),
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


@entry_point
def initialise(records):
    """Check the parameters; new surfaces."""
    r = records[0]
    fault = geometry_fault(r)
    if fault != 0:
        return fault
    prepare(r)
    r.effects_on = 0
    r.standing = 1.0 if r.pins == 1 else 0.0
    prepare_effects(r)
    r.standing = min(1.0, r.standing)
    r.crank_angle_before, r.output_angle_before, r.cage_angle_before = r.crank_angle, r.output_angle, r.cage_angle
    return 0


@kernel
def wear_meshes(r, modulus, viscosity, run_in):
    """Flanks and pins."""
    discs, pins = r.mesh_force.shape
    lobes = pins - 1
    bins = r.arc.shape[0]
    k1 = shortening(r)
    contact_modulus = 0.5 * modulus
    for d in range(discs):
        for j in range(pins):
            force = r.mesh_force[d, j]
            if force <= 0.0:
                continue
            start, end = flank_position(r, d, j, r.crank_angle_before), flank_position(r, d, j, r.crank_angle)
            line_load = force / r.mesh_width
            curvature = equivalent_curvature(
                math.pi * (start + end) / bins, lobes, r.pin_circle_radius, r.pin_radius, k1
            )
            k = wear_coefficient(
                r.mesh_wear_law, r.mesh_wear_coefficient, r.hardness, run_in, r.load_exponent,
                r.reference_line_load, r.roughness, viscosity, modulus, line_load, 1.0 / curvature,
            )
            of_flank = of_pin = r.acceleration * k * line_load
            if r.effects_on:
                middle = 0.5 * (start + end)
                speed = abs(r.crank_speed) * sliding_per_crank_angle(
                    2.0 * math.pi * middle / bins, lobes, r.pin_circle_radius, r.pin_radius, k1
                )
                depth = interpolate_closed(r.disc_wear[d], middle)
                of_flank *= effect_factor(r, FLANK, line_load, 1.0 / curvature, abs(speed), depth, FLANK)
                of_pin *= effect_factor(r, FLANK, line_load, 1.0 / curvature, abs(speed), depth, PIN)
            deepest, place, slid = add_flank_pass(
                r.disc_wear[d], start, end, of_flank, r.slide, r.slide_before, r.arc
            )
            r.flank_volume += of_flank * slid * r.mesh_width
            if deepest > r.flank_depth[d]:
                r.flank_depth[d] = deepest
                r.flank_lobe[d] = place // bins + 1
                r.flank_phase[d] = 2.0 * math.pi * (place % bins + 0.5) / bins
            # The pin loses its share of the same area, all round or where it is touched.
            worn = r.pin_wear_share * of_pin * slid
            r.pin_volume += worn * r.mesh_width
            round_share = 1.0 - r.standing
            r.pin_even_wear[d, j] += round_share * worn / (2.0 * math.pi * r.pin_radius)
            if r.standing == 0.0:
                r.pin_depth[d, j] = r.pin_even_wear[d, j]
            else:
                deepest = wear_standing_pin(r, d, j, start, end, line_load, curvature, contact_modulus, r.standing * worn)
                r.pin_depth[d, j] = max(r.pin_depth[d, j], r.pin_even_wear[d, j] + deepest)


@kernel
def wear_standing_pin(r, d, j, start, end, line_load, curvature, contact_modulus, worn):
    """Spread the worn area over what the contact sweeps on the pin; returns the deepest depth touched.

    Where the contact turns back within the step the sweep has two parts.
    """
    bins, flank_bins = r.pin_wear.shape[2], r.arc.shape[0]
    bin_arc = math.pi * r.pin_radius / bins
    half_width = math.sqrt(4.0 * line_load / (math.pi * curvature * contact_modulus)) / bin_arc
    # The contact on the pin turns back at the phase acos(K1), on either flank.
    turning = math.acos(shortening(r)) / (2.0 * math.pi) * flank_bins
    lobe = math.floor(0.5 * (start + end) / flank_bins) * flank_bins
    split = middle = 0.0
    for side in (lobe + turning, lobe + flank_bins - turning):
        if (start - side) * (end - side) < 0.0:
            split = (side - start) / (end - start)
            middle = pin_position(r, side)
    if split == 0.0:
        return add_footprint(
            r.pin_wear[d, j], pin_position(r, start), pin_position(r, end), half_width, worn / bin_arc
        )[0]
    first = add_footprint(r.pin_wear[d, j], pin_position(r, start), middle, half_width, split * worn / bin_arc)[0]
    second = add_footprint(
        r.pin_wear[d, j], middle, pin_position(r, end), half_width, (1.0 - split) * worn / bin_arc
    )[0]
    return max(first, second)


@kernel
def wear_raceways(r, modulus, viscosity, run_in):
    """Cranks' lobes and holes of the discs: depth k q xi per pass of a roller."""
    discs, cranks, rollers = r.roller_force.shape
    bins = r.inner_race_wear.shape[2]
    bin_angle = 2.0 * math.pi / bins
    inner_radius = 1.0 / (1.0 / r.roller_radius + 1.0 / r.inner_race_radius)
    outer_radius = 1.0 / (1.0 / r.roller_radius - 1.0 / r.outer_race_radius)
    race_speed = abs(r.crank_speed) * 0.5
    for d in range(discs):
        for c in range(cranks):
            inner_start, outer_start = first_roller(
                r, d, c, r.crank_angle_before, r.output_angle_before, r.cage_angle_before
            )
            inner_end, outer_end = first_roller(r, d, c, r.crank_angle, r.output_angle, r.cage_angle)
            for i in range(rollers):
                force = r.roller_force[d, c, i]
                if force <= 0.0:
                    continue
                line_load = force / r.roller_length
                ahead = 2.0 * math.pi * i / rollers
                k_inner = wear_coefficient(
                    r.raceway_wear_law, r.raceway_wear_coefficient, r.hardness, run_in, r.load_exponent,
                    r.reference_line_load, r.roughness, viscosity, modulus, line_load, inner_radius,
                )
                k_outer = wear_coefficient(
                    r.raceway_wear_law, r.raceway_wear_coefficient, r.hardness, run_in, r.load_exponent,
                    r.reference_line_load, r.roughness, viscosity, modulus, line_load, outer_radius,
                )
                amount = r.acceleration * k_inner * line_load * r.slip_ratio_inner
                if r.effects_on:
                    speed = race_speed * r.slip_ratio_inner * r.inner_race_radius
                    depth = interpolate_closed(r.inner_race_wear[d, c], (inner_start + ahead) / bin_angle)
                    amount *= effect_factor(r, INNER, line_load, inner_radius, speed, depth, INNER)
                deepest, place = add_pass(
                    r.inner_race_wear[d, c], (inner_start + ahead) / bin_angle, (inner_end + ahead) / bin_angle, amount
                )
                if deepest > r.inner_race_depth[d, c]:
                    r.inner_race_depth[d, c] = deepest
                    r.inner_race_angle[d, c] = (place + 0.5) * bin_angle
                swept = abs(inner_end - inner_start) * r.inner_race_radius
                r.inner_race_volume += amount * swept * r.roller_length
                amount = r.acceleration * k_outer * line_load * r.slip_ratio_outer
                if r.effects_on:
                    speed = race_speed * r.slip_ratio_outer * r.outer_race_radius
                    depth = interpolate_closed(r.outer_race_wear[d, c], (outer_start + ahead) / bin_angle)
                    amount *= effect_factor(r, OUTER, line_load, outer_radius, speed, depth, OUTER)
                deepest, place = add_pass(
                    r.outer_race_wear[d, c], (outer_start + ahead) / bin_angle, (outer_end + ahead) / bin_angle, amount
                )
                if deepest > r.outer_race_depth[d, c]:
                    r.outer_race_depth[d, c] = deepest
                    r.outer_race_angle[d, c] = (place + 0.5) * bin_angle
                swept = abs(outer_end - outer_start) * r.outer_race_radius
                r.outer_race_volume += amount * swept * r.roller_length


@kernel
def publish_profile_errors(r, lead_time):
    """What the surfaces lack where the contacts will be after ``lead_time`` [s] at the present speed."""
    discs, cranks, rollers = r.roller_force.shape
    pins = r.mesh_force.shape[1]
    bins = r.inner_race_wear.shape[2]
    # Ideal kinematics: the carrier turns by -1/z_c of the crank, the cage rolls along.
    crank_ahead = r.crank_speed * lead_time
    output_ahead = -crank_ahead / (pins - 1.0)
    cage_ahead = (crank_ahead - output_ahead) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
    crank_angle = r.crank_angle + crank_ahead
    for d in range(discs):
        for j in range(pins):
            place = flank_position(r, d, j, crank_angle)
            error = interpolate_closed(r.disc_wear[d], place) + r.pin_even_wear[d, j]
            if r.standing > 0.0:
                error += interpolate_open(r.pin_wear[d, j], pin_position(r, place))
            r.mesh_profile_error[d, j] = error
        for c in range(cranks):
            inner, outer = first_roller(
                r, d, c, crank_angle, r.output_angle + output_ahead, r.cage_angle + cage_ahead
            )
            for i in range(rollers):
                ahead = 2.0 * math.pi * i / rollers
                r.roller_profile_error[d, c, i] = interpolate_closed(
                    r.inner_race_wear[d, c], (inner + ahead) * bins / (2.0 * math.pi)
                ) + interpolate_closed(r.outer_race_wear[d, c], (outer + ahead) * bins / (2.0 * math.pi))


@entry_point
def step(records, time, duration):
    """Wear of one communication step: contacts moved to the present input angles."""
    r = records[0]
    moved = abs(r.crank_angle - r.crank_angle_before)
    if not moved <= math.pi:
        return LONG_STEP
    turned = max(abs(r.output_angle - r.output_angle_before), abs(r.cage_angle - r.cage_angle_before))
    if not turned <= math.pi:
        return CAGE_ASTRAY
    modulus = r.elastic_modulus / (1.0 - r.poisson_ratio * r.poisson_ratio)
    warmer = r.temperature - r.reference_temperature
    viscosity = r.pressure_viscosity * math.exp(-r.pressure_viscosity_slope * warmer)
    run_in = run_in_factor(r.run_in_ratio, r.crank_travel, r.run_in_time * r.run_in_crank_speed)
    if r.acceleration > 0.0 and moved > 0.0:
        wear_meshes(r, modulus, viscosity, run_in)
        wear_raceways(r, modulus, viscosity, run_in)
    r.operating_time += r.acceleration * duration
    r.crank_travel += r.acceleration * moved
    advance_effects(r, r.acceleration * duration)
    r.crank_angle_before, r.output_angle_before, r.cage_angle_before = r.crank_angle, r.output_angle, r.cage_angle
    publish_profile_errors(r, r.contact_lead * duration)
    return 0
