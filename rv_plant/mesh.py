"""Contacts of the discs with the pins."""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, output, scratch, state
from rv_plant.contact import contact_force, damped_force, impact_speed
from rv_plant.dimension import FILE, deviation, length
from rv_plant.geometry import centre_curve_curvature, closest_distance, curvature_and_slopes, least_distance, shortening, turn_of
from rv_plant.near_mesh import NEAR, add_to_disc_and_ring, keep_contact, keep_force

# Pins nearer than this have their distance and phase computed, touching or not; at rest those that may come to touch too [m].
APART = 1e-9


def variables(sizes: Sizes) -> list[Variable]:
    contact, pin, lobe = sizes.over("disc", "pin"), sizes.over("pin"), sizes.over("disc", "lobe")
    return [
        Variable("mesh.profile_error", "input", "m", "what disc and pin lack at their contact", **contact, nominal=1e-6),
        length("pin.radius", "radius of the pins", 1e-5, 2e-3),
        length("pin.circle_radius", "radius of the circle of the pins' centres", 1e-4, 52e-3),
        length("mesh.width", "width of one disc", 1e-5, 8.82e-3),
        length("equidistant_modification", "added to the pin radius when the disc is generated (positive: gap)",
               -1e-3, maximum=1e-3, path="disc.equidistant_modification", display="um"),
        length("shift_modification", "added to the pin circle radius when the disc is generated (negative: gap)",
               -1e-3, maximum=1e-3, path="disc.shift_modification", display="um"),
        Variable("angle_modification", "parameter", "rad", "turning of both flanks of a tooth towards each other (positive: gap)",
                 0.0, minimum=-1e-2, maximum=1e-2, source="assumed: none", path="disc.angle_modification", display="arcmin"),
        Variable("mesh.stiffness", "parameter", "N", "force of disc on pin at 1 mm of penetration, exponent 10/9",
                 3.2e5, minimum=1.0, nominal=1e5, source=FILE),
        Variable("mesh.stiffness_lankarani", "parameter", "N", "force of disc on pin at 1 mm of penetration, Lankarani-Nikravesh law", 3.2e6,
                 minimum=1.0, nominal=1e6, source=FILE),
        Variable("mesh.damping", "parameter", "N.s/m", "coefficient C of disc and pin (law step)", 200.0, minimum=0.0,
                 nominal=100.0, source="assumed: 50 to 500 N s/m per tooth"),
        deviation("pin_position_error_radial", "pin centre outwards", **pin, path="errors.pin.radial"),
        deviation("pin_position_error_tangential", "pin centre along the circle", **pin, path="errors.pin.tangential"),
        deviation("pin_radius_error", "pin radius above nominal", **pin, path="errors.pin.radius"),
        deviation("lobe_profile_error", "material missing on a lobe", **lobe, path="errors.lobe.profile"),
        deviation("lobe_pitch_error", "lobe displaced along the pitch", **lobe, path="errors.lobe.pitch"),
        local("loaded_teeth", "1", "pins that a disc touches", **sizes.over("disc"), nominal=10.0, path="mesh.loaded_teeth"),
        output("mesh.force", "N", "force between disc and pin", **contact, nominal=100.0),
        # What effects add to the ideal parts.
        state("pin_radius_added", "m", "added to the pins' radius: above 0 a thicker pin", **pin),
        state("lobe_gap_added", "m", "material missing on a lobe, along its normal: above 0 a gap", **lobe),
        state("lobe_pitch_added", "m", "lobe displaced along the pitch circle, above 0 counter-clockwise", **lobe),
        state("profile_radius_added", "m", "added to the pin radius that generates the profile: above 0 a gap all round"),
        state("profile_circle_added", "m", "added to the circle radius that generates the profile: above 0 less gap"),
        state("pin_stiffness", "1", "stiffness of a pin's contact and seat over that of the others", **pin),
        state("ring_offset_x", "m", "pin ring out of its place as a disc sees it, along x", **sizes.over("disc")),
        state("ring_offset_y", "m", "pin ring out of its place as a disc sees it, along y", **sizes.over("disc")),
        state("ring_scale", "1", "pin circle radius over that at the reference temperature"),
        state("pin_angle", "rad", "nominal direction of a pin", **pin),
        state("pin_x", "m", "centre of a pin from that of the ring, along x", **pin),
        state("pin_y", "m", "centre of a pin from that of the ring, along y", **pin),
        state("pin_cos", "1", "nominal direction of a pin", **pin),
        state("pin_sin", "1", "nominal direction of a pin", **pin),
        state("mesh_constant", "1", "K of disc and pin in N/m^n"),
        state("mesh_exponent", "1", "n of disc and pin"),
        state("mesh_damping_now", "1", "coefficient of the chosen law for disc and pin"),
        state("phase_shift", "rad", "contact phase less the ideal one", **contact),
        state("mesh_force_now", "N", "force of the last equilibrium", **contact),
        state("mesh_impact_speed", "m/s", "speed of penetration at first touch", **contact),
        *(scratch(name, contact["shape"]) for name in ("mesh_phase", "centre_curvature", "mesh_rate")),
    ]


@kernel
def clear_flanks(r):
    """No effect adds anything to flanks and pins."""
    for d in range(r.lobe_gap_added.shape[0]):
        for lobe in range(r.lobe_gap_added.shape[1]):
            r.lobe_gap_added[d, lobe] = r.lobe_pitch_added[d, lobe] = 0.0
    for j in range(r.pin_radius_added.shape[0]):
        r.pin_radius_added[j] = 0.0
        r.pin_stiffness[j] = 1.0
    r.profile_radius_added = r.profile_circle_added = 0.0


@kernel
def clear_offsets(r):
    """No effect moves the ring against a disc."""
    for d in range(r.ring_offset_x.shape[0]):
        r.ring_offset_x[d] = r.ring_offset_y[d] = 0.0


@kernel
def forget_phases(r):
    """Contacts where they are ideally: where bodies went far off, the search for the closest point may have left its lobe."""
    for d in range(r.phase_shift.shape[0]):
        for j in range(r.phase_shift.shape[1]):
            r.phase_shift[d, j] = 0.0


@kernel
def ring_coordinate(r):
    """Index of the pin ring's turning among the coordinates, after discs, carrier and cranks."""
    discs, cranks = r.roller_force.shape[:2]
    return 3 * discs + 3 + 3 * cranks


@kernel
def mesh_contacts(r, d, ideal_output, axes, rate_weight, kept):
    """Contacts of disc d with the pins: adds to residual and tangent, fills the pin forces.

    r.z holds the disc's departure from ideal kinematics, its shift along axes at the angle
    ``axes`` [rad], r.v its velocity along the same axes.  The tangent is that of the
    residual with respect to z plus ``rate_weight`` [1/s] times that with respect to v; with
    0 nothing moves.  ``kept``: with what ``near_contacts`` needs to go on from here, which only stands still.
    """
    discs, pins = r.mesh_force.shape
    lobes = r.lobe_pitch_error.shape[1]
    circle = r.pin_circle_radius + r.shift_modification + r.profile_circle_added
    radius = r.pin_radius + r.equidistant_modification + r.profile_radius_added
    k1 = shortening(r.eccentricity, lobes, circle)
    hollow = max(0.0, -centre_curve_curvature(0.0, lobes, circle, k1))
    offset = 2.0 * math.pi * d / discs
    # The profile of disc d is cut turned by -offset/lobes against its holes.
    profile_turn = -offset / lobes
    eccentric = -lobes * ideal_output + offset
    ca, sa = math.cos(axes), math.sin(axes)
    zx, zy = r.z[3 * d], r.z[3 * d + 1]
    eccentric_cos, eccentric_sin = math.cos(eccentric), math.sin(eccentric)
    # From the ring's centre as this disc sees it.
    disc_x = r.eccentricity * eccentric_cos + zx * ca - zy * sa - r.ring_offset_x[d]
    disc_y = r.eccentricity * eccentric_sin + zx * sa + zy * ca - r.ring_offset_y[d]
    disc_cos, disc_sin = math.cos(r.z[3 * d + 2]), math.sin(r.z[3 * d + 2])
    ring = ring_coordinate(r)
    ring_cos, ring_sin = r.ring_scale * math.cos(r.z[ring]), r.ring_scale * math.sin(r.z[ring])
    x, y, t = 3 * d, 3 * d + 1, 3 * d + 2
    rx = ry = rt = rr = 0.0
    kxx = kxy = kxt = kxr = kyy = kyt = kyr = ktt = ktr = krr = 0.0
    loaded = 0
    apart = NEAR if kept else APART
    r.near_count[d] = 0
    for j in range(pins):
        # Pin centre from the disc's centre, in the housing and in the profile's frame.
        pin_x = ring_cos * r.pin_x[j] - ring_sin * r.pin_y[j]
        pin_y = ring_cos * r.pin_y[j] + ring_sin * r.pin_x[j]
        px, py = pin_x - disc_x, pin_y - disc_y
        along_disc = lobes * (r.pin_angle[j] - ideal_output - profile_turn)
        # Phases count from the nearest root; the tooth lies between two roots.
        ideal_phase = along_disc - 2.0 * math.pi * math.floor(along_disc / (2.0 * math.pi) + 0.5)
        lobe = math.floor(along_disc / (2.0 * math.pi)) % lobes
        # With one pin more than lobes the ideal phase is also the eccentric's angle less the
        # pin's, and the frame of the ideal contact lies along the pin's direction.
        pin_cos, pin_sin = r.pin_cos[j], r.pin_sin[j]
        ideal_cos = eccentric_cos * pin_cos + eccentric_sin * pin_sin
        ideal_sin = eccentric_sin * pin_cos - eccentric_cos * pin_sin
        cr, sr = disc_cos * pin_cos - disc_sin * pin_sin, disc_sin * pin_cos + disc_cos * pin_sin
        cx, cy = cr * px + sr * py, cr * py - sr * px
        # A flank is displaced along the pitch with its tooth, and turned into it by angle modification.
        flank = 1.0 if ideal_phase >= 0.0 else -1.0
        pitch = (r.lobe_pitch_error[d, lobe] + r.lobe_pitch_added[d, lobe]) / r.pin_circle_radius
        pitch += flank * r.angle_modification
        cx, cy = cx + pitch * cy, cy - pitch * cx
        clearance = radius - r.pin_radius - r.pin_radius_error[j] - r.pin_radius_added[j]
        clearance += r.lobe_profile_error[d, lobe] + r.lobe_gap_added[d, lobe] + r.mesh_profile_error[d, j]
        # Half of the pins are far from touching, which is cheaper to see than how far.
        least = least_distance(cx, cy, ideal_cos, ideal_sin, circle, r.eccentricity, k1, hollow)
        if least + clearance > apart:
            r.mesh_force_now[d, j] = 0.0
            r.mesh_phase[d, j] = ideal_phase + r.phase_shift[d, j]
            continue
        shift, distance, nx, ny, bend = closest_distance(
            cx, cy, ideal_cos, ideal_sin, r.phase_shift[d, j], lobes, circle, r.eccentricity, k1
        )
        r.phase_shift[d, j] = shift
        r.mesh_phase[d, j] = ideal_phase + shift
        r.centre_curvature[d, j] = bend
        gap = distance + clearance
        if gap >= 0.0:
            r.mesh_force_now[d, j] = 0.0
            if gap > apart or not kept:
                continue
        # Gradient of the penetration: (N, arm about the disc, minus arm about the ring),
        # with the normal turned back from the displaced flank.
        nx, ny = nx - pitch * ny, ny + pitch * nx
        nhx, nhy = cr * nx - sr * ny, sr * nx + cr * ny
        gx, gy = ca * nhx + sa * nhy, ca * nhy - sa * nhx
        gt = px * nhy - py * nhx
        gr = pin_y * nhx - pin_x * nhy
        # The normal turns with the disc, and along the flank by its curvature.
        reach, swing = px * nhx + py * nhy, pin_x * nhx + pin_y * nhy
        per_reach = 1.0 / (1.0 + bend * distance)
        bend *= per_reach
        turn = 1.0 - bend * reach
        if kept:
            shift_cos, shift_sin = turn_of(shift)
            curvature, slope, curl, phase_slope = curvature_and_slopes(
                ideal_cos * shift_cos - ideal_sin * shift_sin, ideal_sin * shift_cos + ideal_cos * shift_sin, lobes, circle, k1
            )
            # Along the parallel curve through the pin's centre.
            per_reach = 1.0 / (1.0 + curvature * distance)
            slope, square = slope * per_reach, per_reach * per_reach
            curl = square * (square * curl - 3.0 * distance * slope * slope * per_reach)
            keep_contact(
                r, d, j, -gap, gx, gy, gt, gr, curvature * per_reach, square * slope, curl, reach, swing, slope, phase_slope * per_reach
            )
            if gap >= 0.0:
                continue
        if rate_weight == 0.0:
            force, stiffness = contact_force(-gap, r.mesh_constant * r.pin_stiffness[j], r.mesh_exponent)
            if kept:
                keep_force(r, d, force)
        else:
            rate = gx * r.v[x] + gy * r.v[y] + gt * r.v[t] + gr * r.v[ring]
            r.mesh_rate[d, j] = rate
            force, stiffness, by_rate, elastic = damped_force(
                -gap, rate, r.mesh_constant * r.pin_stiffness[j], r.mesh_exponent, r.damping_law, r.mesh_damping_now,
                r.damping_depth, impact_speed(r.mesh_impact_speed[d, j], rate),
            )
            stiffness += rate_weight * by_rate
            r.potential -= elastic * gap / (r.mesh_exponent + 1.0)
            r.dissipation += (force - elastic) * rate
        r.mesh_force_now[d, j] = force
        loaded += 1
        r.housing_force_x += force * nhx
        r.housing_force_y += force * nhy
        rx += force * gx
        ry += force * gy
        rt += force * gt
        rr += force * gr
        kxx += stiffness * gx * gx
        kxy += stiffness * gx * gy
        kxt += stiffness * gx * gt
        kxr += stiffness * gx * gr
        kyy += stiffness * gy * gy
        kyt += stiffness * gy * gt
        kyr += stiffness * gy * gr
        ktt += stiffness * gt * gt
        ktr += stiffness * gt * gr
        krr += stiffness * gr * gr
        kxx -= force * bend * gy * gy
        kxy += force * bend * gx * gy
        kyy -= force * bend * gx * gx
        kxt -= force * turn * gy
        kyt += force * turn * gx
        ktt += force * turn * reach
        kxr -= force * bend * swing * gy
        kyr += force * bend * swing * gx
        ktr -= force * turn * swing
        krr += force * swing * (1.0 - bend * swing)
    r.loaded_teeth[d] = loaded
    add_to_disc_and_ring(r, d, rx, ry, rt, rr, kxx, kxy, kxt, kxr, kyy, kyt, kyr, ktt, ktr, krr)
