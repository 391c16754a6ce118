"""Friction of the contacts: Stribeck curve when turning, pre-sliding when held.

    mu(v) = mu_c + mu_s exp(-v/v_s) + c v      at every pin, v = |m(phi) omega_crank|
    loss  = sum mu F v + mu_r sum F_roller r_i |omega_crank - omega_disc|

Loss shows at the input: torque + loss/omega.  With the input held, the contacts of discs and pins stick and slip
under the output's torque, and the ring bears what they hold.  N parallel elastic-slip elements (Jenkins, Iwan 1966) carry at
most T_s = (mu_c + mu_s) sum F |arm| together and yield one after the other at theta_i = 2 theta_p i/N: the loop
follows Masing's rules and closes.  Their stiffness goes with the contact forces: where it grows an element keeps
its force, where it falls its stretch, so that a change of load gives no energy away.

Source: Stribeck form after Armstrong-Helouvry 1991; mu 0.04 to 0.12, v_s 5 to 50 mm/s.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from rv_plant.geometry import shortening, sliding_per_crank_angle
from rv_plant.mesh import ring_coordinate
from rv_plant.supports import sliding_friction, sticking_friction

ELEMENTS = 6
# Growth with the load of what friction holds, where it turns back (assumed: more would hold the output for good).
STEEPEST = 0.4
EFFECT = Effect(
    4, "Stribeck friction",
    "mu = mu_c + mu_s exp(-v/v_s) + c v, loss = sum mu F v; held: Iwan elements between carrier and ring up to T_s",
    "Armstrong-Helouvry 1991, Iwan 1966; mu 0.04 to 0.12, v_s 5 to 50 mm/s",
    "input torque against speed has a minimum; a part in proportion to load; hysteresis at reversal with the"
    " input held, its width in proportion to load",
    (
        amplitude("friction_coefficient", "1", "coefficient mu_c of disc and pin beyond the file's", 0.03, 0.0, 0.5, sign=1, group="mesh"),
        amplitude("friction_excess", "1", "mu_s: static friction above mu_c, beyond the file's", 0.03, 0.0, 0.5, sign=1, group="mesh"),
        amplitude("friction_viscous", "s/m", "growth of the coefficient with sliding speed", 0.1, 0.0, 10.0, sign=1, group="viscous"),
        amplitude("bearing_friction", "1", "coefficient of the needle bearings beyond the file's, inner raceway", 0.002, 0.0, 0.1, sign=1, group="bearings"),
        shape("stribeck_speed", "m/s", "speed v_s at which static friction has gone", 0.02, 1e-4, 1.0, "assumed: 5 to 50 mm/s",
              grid=(0.005, 0.02, 0.05), group="mesh"),
        shape("presliding_angle", "rad", "turning theta_p of the held output at which half the elements slip", 2e-5, 1e-7,
              1e-2, "assumed: 4 arcsec", grid=(5e-6, 2e-5, 1e-4), group="mesh"),
    ),
    states=(
        Variable("slider", "state", "rad", "where the elastic-slip elements are free of force", 0.0, (ELEMENTS,), ("element",)),
        Variable("friction_torque", "state", "N.m", "largest torque that friction holds at the output"),
        Variable("holding_load", "state", "N.m", "load of the last equilibrium"),
        Variable("holding_load_before", "state", "N.m", "load of the one before that with another"),
        Variable("held_before", "state", "N.m", "what friction could hold then"),
        Variable("held_last", "state", "N.m", "what friction could hold at the last equilibrium before this"),
        Variable("held_turn", "state", "rad", "turning of the carrier in the ring at the last equilibrium"),
    ),
    signals=("input_torque", "efficiency", "hysteresis", "lost_motion", "no_load_torque", "temperature", "torsional_stiffness"),
)


@kernel
def held_by_last_forces(r):
    """What friction can hold at the output [N m] by the contact forces of the last equilibrium."""
    discs, pins = r.mesh_force_now.shape
    lobes = pins - 1
    k1 = shortening(r.eccentricity, lobes, r.pin_circle_radius)
    held = 0.0
    for d in range(discs):
        for j in range(pins):
            force = r.mesh_force_now[d, j]
            if force > 0.0:
                # Arm of the flank's tangential motion when the disc turns about its own centre.
                c = math.cos(r.mesh_phase[d, j])
                root = math.sqrt(1.0 + k1 * k1 - 2.0 * k1 * c)
                arm = r.pin_circle_radius * root + r.eccentricity * lobes * (c - k1) / root - r.pin_radius
                held += force * abs(arm)
    return (sliding_friction(r) + sticking_friction(r)) * held


@kernel
def before(r):
    """What friction can hold at the output under the present load: from the last two equilibria, so that coarse steps of torque do as well as fine
    ones; at most in proportion to the load."""
    last = r.friction_torque
    r.friction_torque = r.held_last = 0.0
    if r.fidelity != 0 or r.input_speed != 0.0 or sliding_friction(r) + sticking_friction(r) == 0.0:
        return
    known = held_by_last_forces(r)
    slope = 0.0
    load, load_before = abs(r.holding_load), abs(r.holding_load_before)
    if load != load_before and load > 0.0:
        slope = min(max((known - r.held_before) / (load - load_before), 0.0), known / load)
    beyond = abs(r.load_torque) - load
    if (r.load_torque - r.holding_load) * (r.holding_load - r.holding_load_before) < 0.0 < r.load_torque * r.holding_load:
        # The load turns back: what the drive carries stands, and with it what friction can hold, until that has turned round.  Then the drive carries
        # what friction holds beyond the load and no longer below it, or the other way.
        if beyond < 0.0:
            beyond = min(beyond + 2.0 * known, 0.0)
            slope /= 1.0 - 2.0 * min(slope, STEEPEST)
        else:
            beyond = max(beyond - 2.0 * known, 0.0)
            slope /= 1.0 + 2.0 * slope
    r.friction_torque = max(known + slope * beyond, 0.0)
    r.held_last = known
    if r.friction_torque > last:
        # Not by ``z``, from which the next equilibrium is looked for: that may be where a similar run found it.
        for i in range(ELEMENTS):
            r.slider[i] = r.held_turn - (r.held_turn - r.slider[i]) * last / r.friction_torque


@kernel
def element(i, r):
    """(stiffness [N m/rad], largest torque [N m]) of elastic-slip element i."""
    share = r.friction_torque / ELEMENTS
    return share * ELEMENTS / (2.0 * r.presliding_angle * (i + 1.0)), share


@kernel
def turned_in_ring(r):
    """Turning of the carrier against the ring [rad], whose pins hold what friction holds."""
    return r.z[3 * r.throw_added.shape[0]] - r.z[ring_coordinate(r)]


@kernel
def hold(r):
    """The elements resist turning of the carrier against the ring while the input stands."""
    if r.friction_torque == 0.0:
        return
    carrier, ring = 3 * r.throw_added.shape[0], ring_coordinate(r)
    turn = turned_in_ring(r)
    for i in range(ELEMENTS):
        stiffness, most = element(i, r)
        torque = stiffness * (turn - r.slider[i])
        if abs(torque) < most:
            r.tangent[carrier, carrier] += stiffness
            r.tangent[ring, ring] += stiffness
            r.tangent[carrier, ring] -= stiffness
        else:
            torque = most if torque > 0.0 else -most
        r.residual_vector[carrier] += torque
        r.residual_vector[ring] -= torque


@kernel
def after(r):
    """Sliders follow; loss of power when turning."""
    load, turn = r.load_torque, turned_in_ring(r)
    r.held_turn = turn
    if load != r.holding_load:
        # From a turning input on in proportion to the load: what is held at no load is nothing.
        r.holding_load_before = r.holding_load if r.held_last > 0.0 else 0.0
        r.held_before = r.held_last
        r.holding_load = load
    if r.input_speed == 0.0 and r.friction_torque > 0.0:
        for i in range(ELEMENTS):
            stiffness, most = element(i, r)
            stretch = turn - r.slider[i]
            longest = most / stiffness
            if abs(stretch) > longest:
                r.slider[i] = turn - (longest if stretch > 0.0 else -longest)
    else:
        for i in range(ELEMENTS):
            r.slider[i] = turn
    coulomb, excess, bearings = sliding_friction(r), sticking_friction(r), r.roller_friction + r.bearing_friction
    if coulomb + excess + r.friction_viscous + bearings == 0.0:
        return
    discs, cranks, rollers = r.roller_force_now.shape
    pins = r.mesh_force_now.shape[1]
    lobes = pins - 1
    k1 = shortening(r.eccentricity, lobes, r.pin_circle_radius)
    rolling = abs(r.crank_speed) * (1.0 + 1.0 / lobes) * r.inner_race_radius * bearings
    loss = 0.0
    for d in range(discs):
        for j in range(pins):
            force = r.mesh_force_now[d, j]
            if force > 0.0:
                v = abs(r.crank_speed * sliding_per_crank_angle(
                    r.mesh_phase[d, j], lobes, r.pin_circle_radius, r.pin_radius, k1))
                mu = coulomb + excess * math.exp(-v / r.stribeck_speed) + r.friction_viscous * v
                loss += mu * force * v
        for c in range(cranks):
            for k in range(rollers):
                loss += r.roller_force_now[d, c, k] * rolling
    r.friction_power += loss
