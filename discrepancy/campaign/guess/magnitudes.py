"""Units that nobody wrote, by the size of the numbers: never sure."""

import math

from discrepancy.campaign.guess.said import Guess
from discrepancy.campaign.guess.shape import Shape
from discrepancy.held_names import LOCKED_AT

# Ranges that reducers of robot joints have [rad]: transmission errors of catalogues are about an arcmin from peak to peak; a loop at
# rated torque turns by some arcmin (RV-20E: 167 N.m at 49 N.m/arcmin, either way).
USUAL_RANGE = {"transmission_error": math.radians(0.5 / 60.0), "hysteresis": math.radians(8.0 / 60.0), "lost_motion": math.radians(1.0 / 60.0)}
ANGLES = {"arcsec": math.radians(1.0 / 3600.0), "arcmin": math.radians(1.0 / 60.0), "deg": math.radians(1.0), "rad": 1.0}
# Above this speed [rpm] no output of such a reducer turns (assumed).
FASTEST_OUTPUT = 120.0
SIZES = {"input_speed": "faster than outputs turn", "output_speed": "slow enough for the output"}
# A clock that counts from 1970 has more than so many seconds, and more of the parts of one.
EPOCH = 1e9
CLOCKS = {"ns": 1e18, "us": 1e15, "ms": 1e12, "s": EPOCH}
USUAL = {
    "load_torque": "N.m", "torque": "N.m", "input_torque": "N.m", "no_load_torque": "N.m", "hours": "h", "time": "s", "input_speed": "rpm",
    "output_speed": "rpm", "cage_speed": "rpm", "order": "1", "input_order": "1", "vibration": "m/s^2", "vibration_order": "m/s^2",
    "torsional_stiffness": "N.m/arcmin", LOCKED_AT: "deg", "mass_loss": "mg", "debris_iron": "ppm",
}  # fmt: skip


def unit_by_size(role: str, shape: Shape) -> Guess[str]:
    """``role``: an axis or factor, or the quantity for the value's column."""
    if role in USUAL_RANGE:
        best = min(ANGLES, key=lambda unit: abs(math.log(max(shape.span, 1e-300) * ANGLES[unit] / USUAL_RANGE[role])))
        return Guess(best, f"nothing states it; the curve's range is nearest to what reducers have in {best}", False)
    if role in ("angle", "input_angle", "depth_angle"):
        unit = angle_unit(shape)
        return Guess(unit, f"nothing states it; its range is that of turns in {unit}", False)
    if role in ("wear_depth", "wear_profile"):
        unit = "um" if max(abs(shape.low), abs(shape.high)) > 0.05 else "mm"
        return Guess(unit, f"nothing states it; wear of this size is likely in {unit}", False)
    if role == "temperature":
        unit = "K" if shape.low > 200.0 else "degC"
        return Guess(unit, f"nothing states it; likely {unit} by its size", False)
    if role == "efficiency":
        unit = "1" if shape.high <= 1.5 else "%"
        return Guess(unit, f"nothing states it; likely {unit} by its size", False)
    if role == "time" and shape.low > EPOCH:
        unit = next(unit for unit, size in CLOCKS.items() if shape.low > size)
        return Guess(unit, f"nothing states it; it counts {unit} since 1970", False)
    unit = USUAL.get(role, "1")
    return Guess(unit, f"nothing states it; {unit} is usual", role in ("order", "input_order"))


def angle_unit(shape: Shape) -> str:
    turns = shape.span / (2.0 * math.pi)
    whole = abs(turns - round(turns)) < 0.01 * turns and round(turns) >= 1
    return "rad" if whole and shape.span < 100.0 else "deg" if shape.span > 20.0 else "turn" if abs(shape.span - round(shape.span)) < 0.01 else "rad"


def speed_role(high: float) -> Guess[str]:
    """At input or output, by the size of the speed [rpm]."""
    role = "input_speed" if high > FASTEST_OUTPUT else "output_speed"
    return Guess(role, f"{high:.4g} rpm is {SIZES[role]}", False)
