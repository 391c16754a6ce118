"""Output of a plain cycloidal drive: pins of the carrier, with rollers, in holes of the discs.

Hole k of a disc, of radius roller + eccentricity + clearance, is touched by pin k in the direction w of
the pin's centre from the hole's:

    d = |w| - (e + clearance)

Ideally |w| = e, turned half round from the disc's eccentric direction, for all pins.  A
reducer whose output goes through cranks has no such pins; its arrays are of length 1.
"""

import math
from typing import Any

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, scratch, state
from rv_plant.contact import contact_force
from rv_plant.dimension import FILE, length


def variables(sizes: Sizes) -> list[Variable]:
    source = FILE if sizes["output pin"] > 1 else "no output pins: without effect"
    pins: dict[str, Any] = {"needs": ("output_pins", 1)}
    return [
        length("output_pin.radius", "radius of the output pins with their rollers", 1e-5, 5e-3, source=source, **pins),
        length("output_circle_radius", "radius of the circle of the output pins' centres", 1e-4, 20e-3, source=source,
               path="output_pin.circle_radius", **pins),
        length("output_clearance", "hole in the disc beyond roller and eccentricity, in radius", -1e-3, maximum=1e-2,
               source=source, path="output_pin.clearance", display="um", **pins),
        Variable("output_stiffness", "parameter", "N", "force of an output pin on its hole at 1 mm, exponent 10/9", 1e5,
                 minimum=1.0, nominal=1e5, source=source, path="output_pin.stiffness", **pins),
        local("output_pin.force", "N", "force of an output pin on its hole at the present angle",
               **sizes.over("disc", "output pin"), nominal=100.0, **pins),
        state("output_gap_added", "m", "added to the clearance of the output pins"),
        state("output_constant", "1", "K of an output pin in N/m^n"),
        state("output_exponent", "1", "n of an output pin"),
        # Gradient of a contact's distance, see output_contacts.
        scratch("output_columns", (6, 2)),
    ]


@kernel
def has_output_pins(r):
    """Whether the output goes through pins; there are at least three then."""
    return r.output_pin_force.shape[1] > 1


@kernel
def output_contacts(r, d, ideal_output, eccentric):
    """Contacts of disc d with the output pins: adds to residual and tangent, fills the pins' forces.

    ``eccentric`` is the angle [rad] of the disc's ideal centre; coordinates as in assembly.
    """
    discs, pins = r.output_pin_force.shape
    x, y, t, carrier = 3 * d, 3 * d + 1, 3 * d + 2, 3 * discs
    z = r.z
    ce, se = math.cos(eccentric), math.sin(eccentric)
    disc_x = r.eccentricity * ce + z[x] * ce - z[y] * se
    disc_y = r.eccentricity * se + z[x] * se + z[y] * ce
    disc_cos, disc_sin = math.cos(ideal_output + z[t]), math.sin(ideal_output + z[t])
    carrier_cos, carrier_sin = math.cos(ideal_output + z[carrier]), math.sin(ideal_output + z[carrier])
    # d w/d z, for disc (x, y, turning) and carrier (turning, x, y), in this order.
    g = r.output_columns
    g[0, 0], g[0, 1], g[1, 0], g[1, 1] = -ce, -se, se, -ce
    g[4, 0], g[4, 1], g[5, 0], g[5, 1] = 1.0, 0.0, 0.0, 1.0
    for k in range(pins):
        angle = 2.0 * math.pi * k / pins
        px, py = r.output_circle_radius * math.cos(angle), r.output_circle_radius * math.sin(angle)
        hx, hy = disc_cos * px - disc_sin * py, disc_sin * px + disc_cos * py
        ax, ay = carrier_cos * px - carrier_sin * py, carrier_sin * px + carrier_cos * py
        wx, wy = z[carrier + 1] + ax - disc_x - hx, z[carrier + 2] + ay - disc_y - hy
        distance = math.sqrt(wx * wx + wy * wy)
        force, stiffness = contact_force(
            distance - r.eccentricity - r.output_clearance - r.output_gap_added, r.output_constant, r.output_exponent
        )
        r.output_pin_force[d, k] = force
        if force == 0.0:
            continue
        nx, ny = wx / distance, wy / distance
        g[2, 0], g[2, 1] = hy, -hx
        g[3, 0], g[3, 1] = -ay, ax
        # The normal turns with the direction of w; levers turn with disc and carrier.
        swing = force / distance
        r.tangent[t, t] += force * (nx * hx + ny * hy)
        r.tangent[carrier, carrier] -= force * (nx * ax + ny * ay)
        for a in range(6):
            ia = output_coordinate(a, d, carrier)
            if not r.is_free[ia]:
                continue
            along, across = nx * g[a, 0] + ny * g[a, 1], nx * g[a, 1] - ny * g[a, 0]
            r.residual_vector[ia] += force * along
            for b in range(a, 6):
                ib = output_coordinate(b, d, carrier)
                if r.is_free[ib]:
                    r.tangent[ia, ib] += stiffness * along * (nx * g[b, 0] + ny * g[b, 1])
                    r.tangent[ia, ib] += swing * across * (nx * g[b, 1] - ny * g[b, 0])


@kernel
def output_coordinate(column, d, carrier):
    """Index in z of one of a contact's six columns; increasing with the column."""
    return 3 * d + column if column < 3 else carrier + column - 3
