"""Noise of a usual bench, for what was not measured yet and of which nobody stated it."""

# Standard deviation of a sample, SI units (assumed).
UNMEASURED = {
    "transmission_error": 2.5e-6, "hysteresis": 5e-6, "lost_motion": 1e-5, "torsional_stiffness": 2e3,
    "input_torque": 0.02, "no_load_torque": 0.01, "cage_speed": 0.01, "wear_depth": 1e-7,
}  # fmt: skip
