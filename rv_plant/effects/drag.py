"""Drag of seals and churned grease: torque at the input without any load.

    T_0 = a + b (|n|/n_0)^(2/3) (nu/nu_0)^(2/3),  nu/nu_0 = exp(-beta (T - T_0))

Source: no-load torque of rolling bearings after Palmgren (n nu)^(2/3); no-load torque of RV reducers 0.1 to 0.6 N m at the input.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.gear_stage import total_ratio

EFFECT = Effect(
    5, "churning and seal drag",
    "T_0 = a + b (n/n_0)^(2/3) (nu/nu_0)^(2/3), nu = nu_0 exp(-beta (T - T_0))",
    "Palmgren's (n nu)^(2/3); 0.1 to 0.6 N m at the input",
    "independent of load; falls with temperature (cold start); grows with speed",
    (
        amplitude("seal_torque", "N.m", "seals: constant torque at the input beyond the file's", 0.1, 0.0, 100.0, sign=1),
        amplitude("churning_torque", "N.m", "churning beyond the file's, at the reference speed and temperature", 0.1, 0.0, 100.0, sign=1),
        shape("churning_speed", "rad/s", "input speed n_0 that the churning torque holds for", 209.44, 1e-3, 1e5, "2000 rpm", held=True),
        shape("viscosity_slope", "1/K", "beta: relative fall of viscosity with temperature", 0.035, 0.0, 0.2,
              "assumed: mineral oil, halves in 20 K", grid=(0.02, 0.035, 0.05)),
        shape("viscosity_reference", "K", "temperature T_0 that the churning torque holds for", 293.15, 200.0, 500.0, "assumed: room temperature", held=True),
    ),
    signals=("input_torque", "efficiency", "no_load_torque", "temperature"),
)


@kernel
def after(r):
    seals, churning = r.input_seal_torque + r.seal_torque, r.input_churning_torque + r.churning_torque
    if seals + churning == 0.0:
        return
    viscosity = r.grease_thinning * math.exp(-r.viscosity_slope * (r.reducer_temperature - r.viscosity_reference))
    lobes = r.lobe_gap_added.shape[1]
    speed = abs(r.crank_speed / lobes * total_ratio(r.first_stage_ratio, lobes + 1, lobes))
    torque = seals + churning * (speed / r.churning_speed * viscosity) ** (2.0 / 3.0)
    r.friction_power += torque * speed
