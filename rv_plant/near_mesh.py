"""Discs and pins a little beside a position whose geometry is known.

The closest distances of an equilibrium's first assembly are carried on, so what is left to iterate is which
contacts touch and how hard.  Of a pin that moves by a along the disc's normal and by b along its tangent

    penetration = p - a - k (1 - k a) b^2/2 - k' b^3/6 - k'' b^4/24,
    normal turned by k b (1 - k a) - (k b)^3/3 + k' b^2/2 + k'' b^3/6 and with the disc,

k the curvature of the curve that runs parallel to the flank through the pin's centre, k' and k'' its derivatives along it.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, scratch
from rv_plant.contact import force_beside
from rv_plant.coordinates import coordinate_count
from rv_plant.output_pins import has_output_pins

# So far [m] beside the known position may be iterated; pins further apart than this are left out there.
NEAR = 5e-7
# At this way [m] the residual is off by so much of the load at most (measured 3.6e-10), which goes with its third power.
EXACT, MISSED = 2e-7, 5e-10


def variables(sizes: Sizes) -> list[Variable]:
    discs, pins = sizes["disc"], sizes["pin"]
    return [
        # Penetration; its gradient by x, y and turning of the disc and turning of the ring;
        # k, k', k''; arms of the normal about disc and ring; curvature of the centre curve and its change by b; force; phase and its change by b.
        scratch("near_contact", (discs, pins, 15)), scratch("near_pin", (discs, pins), integer=True),
        scratch("near_count", (discs,), integer=True), scratch("near_z", (coordinate_count(sizes),)),
        # Beside z, what the geometry there depends on: angle of the output, scale of the ring, its place as each disc sees it.
        scratch("near_at", (2 + 2 * discs,)),
        # 1: nothing else is changed from one equilibrium to the next, so that one may be carried on to another.
        scratch("near_held", (1,), integer=True),
    ]


@kernel
def keep_place(r, ideal_output):
    """The geometry is known from here on for the present coordinates."""
    for i in range(r.near_z.shape[0]):
        r.near_z[i] = r.z[i]
    r.near_at[0], r.near_at[1] = ideal_output, r.ring_scale
    for d in range(r.ring_offset_x.shape[0]):
        r.near_at[2 + 2 * d], r.near_at[3 + 2 * d] = r.ring_offset_x[d], r.ring_offset_y[d]


@kernel
def is_held(r, ideal_output):
    """Whether what is known of the last equilibrium's geometry still holds: the same but for forces and coordinates."""
    if r.near_held[0] == 0 or r.near_at[0] != ideal_output or r.near_at[1] != r.ring_scale:
        return False
    for d in range(r.ring_offset_x.shape[0]):
        if r.near_at[2 + 2 * d] != r.ring_offset_x[d] or r.near_at[3 + 2 * d] != r.ring_offset_y[d]:
            return False
    return True


@kernel
def keep_contact(r, d, j, penetration, gx, gy, gt, gr, bend, slope, curl, reach, swing, centre_slope, phase_slope):
    """A pin near disc d."""
    r.near_pin[d, r.near_count[d]] = j
    c = r.near_contact[d, r.near_count[d]]
    c[0], c[1], c[2], c[3], c[4] = penetration, gx, gy, gt, gr
    c[5], c[6], c[7], c[8], c[12] = bend, slope, reach, swing, curl
    c[9], c[10], c[11] = r.centre_curvature[d, j], centre_slope, 0.0
    c[13], c[14] = r.mesh_phase[d, j], phase_slope
    r.near_count[d] += 1


@kernel
def keep_force(r, d, force):
    """Of the pin kept last."""
    r.near_contact[d, r.near_count[d] - 1, 11] = force


@kernel
def way_from_place(r):
    """How far [m] any contact of disc and pin has moved since the geometry was known."""
    discs, last, lever = r.mesh_force.shape[0], r.near_z.shape[0] - 1, r.pin_circle_radius
    way = 0.0
    for d in range(discs):
        dx, dy = r.z[3 * d] - r.near_z[3 * d], r.z[3 * d + 1] - r.near_z[3 * d + 1]
        way = max(way, math.sqrt(dx * dx + dy * dy) + lever * abs(r.z[3 * d + 2] - r.near_z[3 * d + 2]))
    return way + lever * abs(r.z[last] - r.near_z[last])


@kernel
def is_near(r):
    """Whether contacts may be carried on from the known position; output pins may not."""
    return way_from_place(r) <= NEAR and not has_output_pins(r)


@kernel
def missed(r):
    """What residual the carried contacts may leave out, over the load."""
    share = way_from_place(r) / EXACT
    return share * share * share * MISSED


@kernel
def add_to_disc_and_ring(r, d, rx, ry, rt, rr, kxx, kxy, kxt, kxr, kyy, kyt, kyr, ktt, ktr, krr):
    """What all pins do to disc d (x, y, turning) and to the ring's turning: into residual and tangent."""
    x, y, t, ring = 3 * d, 3 * d + 1, 3 * d + 2, r.near_z.shape[0] - 1
    r.residual_vector[x] += rx
    r.residual_vector[y] += ry
    r.residual_vector[t] += rt
    r.residual_vector[ring] += rr
    k = r.tangent
    k[x, x] += kxx
    k[x, y] += kxy
    k[x, t] += kxt
    k[x, ring] += kxr
    k[y, y] += kyy
    k[y, t] += kyt
    k[y, ring] += kyr
    k[t, t] += ktt
    k[t, ring] += ktr
    k[ring, ring] += krr


@kernel
def near_contacts(r, d, axes):
    """As ``mesh_contacts`` at rest, by what is kept of the known position."""
    x, y, t, ring = 3 * d, 3 * d + 1, 3 * d + 2, r.near_z.shape[0] - 1
    ca, sa = math.cos(axes), math.sin(axes)
    dx, dy, dt, dr = r.z[x] - r.near_z[x], r.z[y] - r.near_z[y], r.z[t] - r.near_z[t], r.z[ring] - r.near_z[ring]
    rx = ry = rt = rr = 0.0
    kxx = kxy = kxt = kxr = kyy = kyt = kyr = ktt = ktr = krr = 0.0
    loaded = 0
    for i in range(r.near_count[d]):
        j, c = r.near_pin[d, i], r.near_contact[d, i]
        gx, gy, gt, gr = c[1], c[2], c[3], c[4]
        bend, slope, curl, reach, swing = c[5], c[6], c[12], c[7], c[8]
        across = gy * dx - gx * dy + swing * dr
        inwards = gx * dx + gy * dy + gt * dt + gr * dr + 0.5 * (swing * dr * dr + reach * dt * dt) - dt * across
        b = across - reach * dt
        along = 1.0 + bend * inwards
        penetration = c[0] + inwards - b * b * (0.5 * bend * along + b * (slope * (1.0 / 6.0) + curl * b * (1.0 / 24.0)))
        if penetration <= 0.0:
            r.mesh_force_now[d, j] = 0.0
            continue
        force, stiffness = force_beside(penetration, c[0], c[11], r.mesh_constant * r.pin_stiffness[j], r.mesh_exponent)
        r.mesh_force_now[d, j] = force
        r.centre_curvature[d, j] = c[9] + c[10] * b
        r.mesh_phase[d, j] = c[13] + c[14] * b
        loaded += 1
        # The normal turned, and its arms.
        bent = bend * b
        by = bent * (along - bent * bent * (1.0 / 3.0)) + b * b * (0.5 * slope + curl * b * (1.0 / 6.0)) + dt
        cosine, sine = 1.0 - 0.5 * by * by, by * (1.0 - by * by * (1.0 / 6.0))
        hx, hy = cosine * gx - sine * gy, cosine * gy + sine * gx
        ht, hr = cosine * gt + sine * reach - across, cosine * gr - sine * swing + dr * swing
        turn = 1.0 - bend * reach
        r.housing_force_x += force * (ca * hx - sa * hy)
        r.housing_force_y += force * (sa * hx + ca * hy)
        rx += force * hx
        ry += force * hy
        rt += force * ht
        rr += force * hr
        kxx += stiffness * hx * hx - force * bend * gy * gy
        kxy += stiffness * hx * hy + force * bend * gx * gy
        kxt += stiffness * hx * ht - force * turn * gy
        kxr += stiffness * hx * hr - force * bend * swing * gy
        kyy += stiffness * hy * hy - force * bend * gx * gx
        kyt += stiffness * hy * ht + force * turn * gx
        kyr += stiffness * hy * hr + force * bend * swing * gx
        ktt += stiffness * ht * ht + force * turn * reach
        ktr += stiffness * ht * hr - force * turn * swing
        krr += stiffness * hr * hr + force * swing * (1.0 - bend * swing)
    r.loaded_teeth[d] = loaded
    add_to_disc_and_ring(r, d, rx, ry, rt, rr, kxx, kxy, kxt, kxr, kyy, kyt, kyr, ktt, ktr, krr)
