"""Friction of the whole drive, as it shows when the output is locked and the input is turned.

    T = T_el(phi) + T_f(phi),  |T_f| <= T_0 + s |T_el|

All torques are referred to the output, phi is the input's turning over the ratio.  T_el is what
contacts, clearances and springs hold without friction; friction lies beside all of
them, because the input rolls through the mesh while they yield.  N elastic-slip elements (Jenkins, Iwan 1966) yield one after
the other at phi_i = 2 phi_p i/N of turning back.  T_0 comes from preload and seals, s from the contacts' load.
Turning, the drive loses (T_0 + s |T|) omega_output.

Source: Iwan 1966; efficiency of cycloidal drives 60 to 90 %, no-load torque of preloaded ones.
"""

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

ELEMENTS = 8
# Halvings of the range of turning when torque is given and turning is sought.
HALVINGS = 48
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


@kernel
def elastic_torque(turning, torques, phi):
    """Torque [N m] at a turning [rad], linear between the rising ``turning`` of a table."""
    low, high = 0, turning.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if turning[middle] > phi:
            high = middle
        else:
            low = middle
    width = turning[high] - turning[low]
    share = (phi - turning[low]) / width if width > 0.0 else 0.5
    return torques[low] + share * (torques[high] - torques[low])


@kernel
def locked_output_loop(turning, torques, applied, friction, share, presliding, sliders, found):
    """Fill ``found`` [rad] with the turning under ``applied`` torques [N m] in order, from the table of the elastic
    drive; ``sliders`` keep the elements' places."""
    n = sliders.shape[0]
    for i in range(applied.shape[0]):
        low, high = turning[0], turning[turning.shape[0] - 1]
        for _ in range(HALVINGS):
            phi = 0.5 * (low + high)
            held = elastic_torque(turning, torques, phi)
            most = (friction + share * abs(held)) / n
            for k in range(n):
                stretch = (phi - sliders[k]) / (2.0 * presliding * (k + 1.0) / n)
                held += most * min(max(stretch, -1.0), 1.0)
            if held > applied[i]:
                high = phi
            else:
                low = phi
        phi = 0.5 * (low + high)
        for k in range(n):
            longest = 2.0 * presliding * (k + 1.0) / n
            sliders[k] = min(max(sliders[k], phi - longest), phi + longest)
        found[i] = phi
