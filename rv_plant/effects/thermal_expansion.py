"""Heating, and the gap that grows or shrinks with temperature.

    dT/dt = (T_ambient + R P_loss - T)/tau
    pin circle radius over the discs': dR = alpha_T (T - T_ref) R

alpha_T is the difference that counts: of the materials' expansion, or of the temperatures
of ring and discs as both warm up (11.5e-6/K times the share by which the discs stay
behind or lead).  tau = 0 is the steady state.

Source: linear expansion; 3 to 12 um at a circle of 52 mm for 5 to 20 K; housing time constants 20 to 60 min.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from fmu_src.variables import Variable

EFFECT = Effect(
    6, "thermal expansion",
    "dR = alpha_T (T - T_ref) R, dT/dt = (T_ambient + R_th P_loss - T)/tau",
    "linear expansion, 11.5e-6/K of steel; time constant 20 to 60 min",
    "lost motion, mean transmission error and stiffness at low torque follow the temperature, with the housing's"
    " time constant, reversibly; the only one that shows at standstill, hot against cold",
    (
        amplitude("thermal_expansion", "1/K", "growth of the pin circle over the discs per kelvin", 2e-6, -1e-4, 1e-4, group="expansion"),
        amplitude("thermal_resistance", "K/W", "warming of the reducer per watt lost", 0.1, 0.0, 100.0, sign=1, group="heating"),
        shape("thermal_time", "s", "time constant of warming; 0: steady state at once", 0.0, 0.0, 1e6, "assumed: steady", display="h", held=True),
        shape("thermal_reference", "K", "temperature at which the gaps are those of the file", 293.15, 200.0, 500.0,
              "assumed: room temperature", held=True),
    ),
    states=(Variable("housing_temperature", "state", "K", "temperature reached with the time constant of warming"),),
    signals=("lost_motion", "hysteresis", "transmission_error", "torsional_stiffness", "temperature", "input_torque", "efficiency"),
)


@kernel
def start(r):
    r.housing_temperature = r.temperature


@kernel
def warm(r):
    if r.thermal_time > 0.0:
        r.reducer_temperature += r.housing_temperature - r.temperature
    else:
        r.reducer_temperature += r.thermal_resistance * r.friction_power


@kernel
def before(r):
    r.ring_scale *= 1.0 + r.thermal_expansion * (r.reducer_temperature - r.thermal_reference)


@kernel
def heat(r, duration):
    if r.thermal_time > 0.0:
        target = r.temperature + r.thermal_resistance * r.friction_power
        change = (target - r.housing_temperature) * -math.expm1(-duration / r.thermal_time)
        r.housing_temperature += change
        r.reducer_temperature += change
