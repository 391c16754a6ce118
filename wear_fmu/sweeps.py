"""What contacts take off as they sweep from one place to another.

A part of a step leads from ``crank_from`` to ``crank_to`` (carrier and cages alike); each contact
presses with its mean force, and passes ``passes`` times where the cranks went to and fro between.
"""

import math

from fmu_src.effect import compose
from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, scratch
from wear_fmu.chosen_surfaces import FLANK, GUARDS, INNER, OUTER, PIN
from wear_fmu.contacts import first_roller, flank_position, pin_position, shortening
from wear_fmu.effects import HOOKS
from wear_fmu.kinematics import equivalent_curvature, sliding_per_crank_angle
from wear_fmu.surfaces import add_flank_pass, add_footprint, add_pass, interpolate_closed
from wear_fmu.wear_laws import exponents, wear_coefficient

effect_factor = compose("wear_fmu.effects", HOOKS, GUARDS).factor


def variables(sizes: Sizes) -> list[Variable]:
    return [
        *(scratch(f"{name}_{end}") for name in ("crank", "carrier", "cages") for end in ("from", "to")),
        scratch("passes"),
    ]


@kernel
def swept_part(r, share_from, share_to):
    """Take the part of the step between two shares of it."""
    crank, carrier, cages = r.crank_angle_before, r.output_angle_before, r.cage_angle_before
    turned = r.crank_angle - crank
    r.crank_from, r.crank_to = crank + share_from * turned, crank + share_to * turned
    r.carrier_from = carrier + share_from * (r.output_angle - carrier)
    r.carrier_to = carrier + share_to * (r.output_angle - carrier)
    r.cages_from = cages + share_from * (r.cage_angle - cages)
    r.cages_to = cages + share_to * (r.cage_angle - cages)
    if share_to == 1.0:
        r.crank_to, r.carrier_to, r.cages_to = r.crank_angle, r.output_angle, r.cage_angle
    r.passes = 1.0
    # There and back within the step: nobody knows where the turning points were; they are put evenly about the known ends.
    hidden = r.path - abs(turned)
    if hidden > 1e-9 * r.path:
        beyond = 0.25 * (share_to - share_from) * (hidden if turned >= 0.0 else -hidden)
        rolled = beyond * (1.0 + 1.0 / (r.mesh_force.shape[1] - 1.0)) * r.inner_race_radius / (r.inner_race_radius + r.outer_race_radius)
        r.crank_from, r.crank_to = r.crank_from - beyond, r.crank_to + beyond
        r.cages_from, r.cages_to = r.cages_from - rolled, r.cages_to + rolled
        carried = beyond / (r.mesh_force.shape[1] - 1.0)
        r.carrier_from, r.carrier_to = r.carrier_from + carried, r.carrier_to - carried
        r.passes = (share_to - share_from) * r.path / abs(r.crank_to - r.crank_from)


@kernel
def wear_meshes(r, modulus, viscosity, run_in, after):
    """Flanks and pins; ``after`` is the part's middle within the step, from -1/2 to 1/2."""
    discs, pins = r.mesh_force.shape
    lobes = pins - 1
    bins = r.arc.shape[0]
    k1 = shortening(r)
    contact_modulus = 0.5 * modulus
    of_load, of_radius = exponents(r.mesh_wear_law, r.load_exponent)
    needs_curvature = of_radius != 0.0 or r.effects_on != 0 or r.standing > 0.0
    unit = wear_coefficient(
        r.mesh_wear_law, r.mesh_wear_coefficient, r.hardness, run_in, r.load_exponent,
        r.reference_line_load, r.roughness, viscosity, modulus, 1.0, 1.0,
    )
    for d in range(discs):
        for j in range(pins):
            force = r.mesh_mean[d, j] + after * r.mesh_trend[d, j]
            if force <= 0.0:
                continue
            start, end = flank_position(r, d, j, r.crank_from), flank_position(r, d, j, r.crank_to)
            line_load = force / r.mesh_width
            curvature, k = 0.0, unit * line_load**of_load
            if needs_curvature:
                curvature = equivalent_curvature(
                    math.pi * (start + end) / bins, lobes, r.pin_circle_radius, r.pin_radius, k1
                )
                k *= curvature**-of_radius
            of_flank = of_pin = r.acceleration * r.passes * k * line_load
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
def wear_race(r, surface, worn, start, end, ahead, unit, power, line_load, slip, race_radius, contact_radius):
    """Pass of one roller ``ahead`` of the first [rad] over one raceway, ``worn`` (bins,): (deepest [m], where [rad], volume lost [m^3])."""
    bin_angle = 2.0 * math.pi / worn.shape[0]
    amount = r.acceleration * r.passes * unit * power * line_load * slip
    if r.effects_on:
        speed = abs(r.crank_speed) * 0.5 * slip * race_radius
        depth = interpolate_closed(worn, (start + ahead) / bin_angle)
        amount *= effect_factor(r, surface, line_load, contact_radius, speed, depth, surface)
    deepest, place = add_pass(worn, (start + ahead) / bin_angle, (end + ahead) / bin_angle, amount)
    swept = abs(end - start) * race_radius
    return deepest, (place + 0.5) * bin_angle, amount * swept * r.roller_length


@kernel
def wear_raceways(r, modulus, viscosity, run_in, after):
    """Cranks' eccentrics and holes of the discs: depth k q xi per pass of a roller; ``after`` as in ``wear_meshes``."""
    discs, cranks, rollers = r.roller_force.shape
    inner_radius = 1.0 / (1.0 / r.roller_radius + 1.0 / r.inner_race_radius)
    outer_radius = 1.0 / (1.0 / r.roller_radius - 1.0 / r.outer_race_radius)
    of_load, of_radius = exponents(r.raceway_wear_law, r.load_exponent)
    unit = wear_coefficient(
        r.raceway_wear_law, r.raceway_wear_coefficient, r.hardness, run_in, r.load_exponent,
        r.reference_line_load, r.roughness, viscosity, modulus, 1.0, 1.0,
    )
    unit_inner, unit_outer = unit * inner_radius**of_radius, unit * outer_radius**of_radius
    for d in range(discs):
        for c in range(cranks):
            inner_start, outer_start = first_roller(r, d, c, r.crank_from, r.carrier_from, r.cages_from)
            inner_end, outer_end = first_roller(r, d, c, r.crank_to, r.carrier_to, r.cages_to)
            for i in range(rollers):
                force = r.roller_mean[d, c, i] + after * r.roller_trend[d, c, i]
                if force <= 0.0:
                    continue
                line_load = force / r.roller_length
                ahead = 2.0 * math.pi * i / rollers
                power = line_load**of_load
                deepest, angle, volume = wear_race(
                    r, INNER, r.inner_race_wear[d, c], inner_start, inner_end, ahead, unit_inner, power, line_load, r.slip_ratio_inner, r.inner_race_radius,
                    inner_radius,
                )
                if deepest > r.inner_race_depth[d, c]:
                    r.inner_race_depth[d, c], r.inner_race_angle[d, c] = deepest, angle
                r.inner_race_volume += volume
                deepest, angle, volume = wear_race(
                    r, OUTER, r.outer_race_wear[d, c], outer_start, outer_end, ahead, unit_outer, power, line_load, r.slip_ratio_outer, r.outer_race_radius,
                    outer_radius,
                )
                if deepest > r.outer_race_depth[d, c]:
                    r.outer_race_depth[d, c], r.outer_race_angle[d, c] = deepest, angle
                r.outer_race_volume += volume
