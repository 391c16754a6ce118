"""Support with memory: the seat of the pin ring slips and sticks (Dahl), beside a spring.

    M = psi/c + F,  dF/dpsi = rho/c (1 - F/F_s sign(dpsi))

M is the ring's torque, psi the seat's turning.  At rest and after each reversal the joint is stuck, 1 + rho times as stiff as
the spring; after a way of some F_s c/rho it slips at F_s.  F and psi are remembered, through loops with the input held and
through turning that reverses its torque.  Along a way without reversal the law has a closed solution,
so that the steps do not matter:

    F = s F_s + (F_0 - s F_s) exp(-rho |psi - psi_0|/(c F_s)),  s = sign(psi - psi_0)

What else yields under the ring, c_0, lies in series with the seat and sticks nowhere: the ring turns by psi + c_0 M.

It is LuGre's model (Canudas de Wit 1995) as slowly as a housing yields, where what depends on speed has no part.
In motion (fidelity dynamic) the spring alone acts.

Source: Dahl 1968, 1976; bolted joints: 1 to 30 % of the torque held by friction.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from rv_plant.mesh import ring_coordinate

# Of Newton's steps to where the seat stands, and when they end, of the ring's turning.
MOST_STEPS, CLOSE = 60, 1e-13

EFFECT = Effect(
    0, "support with memory (Dahl)",
    "M = psi/c + F, dF/dpsi = rho/c (1 - F/F_s sign(dpsi)); in series with what else yields under the ring",
    "Dahl 1968; bolted joints: 1 to 30 % of the torque held by friction",
    "loops whose width does not grow with the torque once the joint slips, with steep beginnings after each reversal; narrow ones"
    " for small torques; independent of speed",
    (
        amplitude("support_slip_compliance", "rad/(N.m)", "c: turning of the pin ring per torque once its seat slips", 1e-7, 0.0, 1e-2,
                  sign=1, source="assumed: rigid, as in both sources"),
        shape("support_slip_torque", "N.m", "F_s: torque at which the ring's seat slips", 20.0, 1e-2, 5000.0, "assumed: a tenth of the rated torque",
              grid=(8.0, 40.0)),
        shape("support_stick_ratio", "1", "rho: stiffness of friction when stuck over that of the spring", 4.0, 0.1, 100.0,
              "assumed: stuck five times as stiff", grid=(2.0, 8.0)),
    ),
    states=(
        Variable("support_force", "state", "N.m", "F: what friction of the ring's seat holds"),
        Variable("support_turn", "state", "rad", "psi: where the seat stood when F was so"),
    ),
    signals=("hysteresis", "lost_motion", "torsional_stiffness", "transmission_error"),
)  # fmt: skip


@kernel
def start(r):
    r.support_force = r.support_turn = 0.0


@kernel
def prepare(r):
    r.compliance[ring_coordinate(r)] += r.support_slip_compliance


@kernel
def in_series(r):
    """c_0 [rad/(N m)]: what yields under the ring besides the seat."""
    return max(r.compliance[ring_coordinate(r)] - r.support_slip_compliance, 0.0)


@kernel
def along(r, way, most):
    """(F [N m], dF/dpsi [N m/rad]) after a way [rad] from where the seat was last, towards ``most``, F_s with the way's sign."""
    stiffness = r.support_stick_ratio / r.support_slip_compliance
    left = math.exp(-stiffness * way / most)
    return most + (r.support_force - most) * left, stiffness * left * (1.0 - r.support_force / most)


@kernel
def seat_at(r, turn):
    """(F [N m], dF/dpsi [N m/rad], psi [rad]) where the ring has turned by ``turn``.

    Newton's way there never passes it, for F only flattens along a way.
    """
    c, rest = r.support_slip_compliance, in_series(r)
    ahead = turn - r.support_turn - rest * (r.support_turn / c + r.support_force)
    most = r.support_slip_torque if ahead >= 0.0 else -r.support_slip_torque
    way = 0.0
    for _ in range(MOST_STEPS):
        force, stiffness = along(r, way, most)
        psi = r.support_turn + way
        step = (turn - psi - rest * (psi / c + force)) / (1.0 + rest * (1.0 / c + stiffness))
        way += step
        if abs(step) <= CLOSE * abs(turn):
            break
    force, stiffness = along(r, way, most)
    return force, stiffness, r.support_turn + way


@kernel
def hold(r):
    if r.support_slip_compliance == 0.0:
        return
    ring = ring_coordinate(r)
    c, rest = r.support_slip_compliance, in_series(r)
    force, stiffness, _ = seat_at(r, r.z[ring])
    # The spring of both is there already: of M = turn/(c + c_0) + F c/(c + c_0) this is the rest.
    share = c / (c + rest)
    r.residual_vector[ring] += share * force
    r.tangent[ring, ring] += share * stiffness / (1.0 + rest * (1.0 / c + stiffness))


@kernel
def after(r):
    if r.support_slip_compliance == 0.0:
        return
    force, _, psi = seat_at(r, r.z[ring_coordinate(r)])
    r.support_force = force
    r.support_turn = psi
