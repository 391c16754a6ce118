"""Friction of the whole drive, as it shows when the output is locked and the input is turned.

    T = T_el(phi) + T_f(phi),  |T_f| <= T_0 + s |T_el|

All torques are referred to the output, phi is the input's turning over the ratio.  T_el is what
contacts, clearances and springs hold without friction; friction lies beside all of
them, because the input rolls through the mesh while they yield.  N elastic-slip elements (Jenkins, Iwan 1966) yield one after
the other at phi_i = 2 phi_p i/N of turning back.  T_0 comes from preload and seals, s from the contacts' load.
Turning, the drive loses (T_0 + s |T|) omega_output; the loop is ``rv_plant.locked_output``'s.

Source: Iwan 1966; efficiency of cycloidal drives 60 to 90 %, no-load torque of preloaded ones.
"""

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

EFFECT = Effect(
    0, "drive friction",
    "T = T_el(phi) + T_f, |T_f| <= T_0 + s |T_el|; Iwan elements",
    "Iwan 1966; s 0.05 to 0.4",
    "loop with the output locked: width at no torque by T_0, growing with torque by s; turning stands still at reversal",
    (
        amplitude("drive_friction", "N.m", "T_0: friction torque at the output without load", 0.5, 0.0, 1000.0, sign=1),
        amplitude("drive_friction_share", "1", "s: friction torque over elastic torque", 0.1, 0.0, 0.9, sign=1),
        shape("drive_presliding", "rad", "phi_p: turning back at which half of the elements slip", 1e-3, 1e-5, 0.05,
              "assumed: 3 arcmin", grid=(3e-4, 3e-3)),
    ),
    signals=("hysteresis",),
    needs="locked output",
)  # fmt: skip


@kernel
def after(r):
    if r.drive_friction + r.drive_friction_share == 0.0:
        return
    speed = abs(r.crank_speed) / r.lobe_gap_added.shape[1]
    r.friction_power += (r.drive_friction + r.drive_friction_share * abs(r.load_torque)) * speed
