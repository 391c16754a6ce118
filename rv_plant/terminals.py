"""Where a system model takes hold of the reducer: flanges, housing, heat, and the bus to the wear unit."""

from fmu_src.terminals import Member, Terminal

MECHANICAL = (
    Terminal("input", "input flange: speed or torque in, by drive", "flange", "plug", (-100.0, 0.0), (
        Member("angle", "input.angle"), Member("speed", "input.speed"), Member("torque", "input.torque"), Member("drive_torque", "input.drive_torque"),
    )),
    Terminal("output", "output flange: torque of the load in, positive against positive rotation", "flange", "plug", (100.0, 0.0), (
        Member("angle", "output.angle"), Member("speed", "output.speed"), Member("torque", "output.load_torque"),
    )),
    Terminal("housing", "what holds the pin ring: torque and force", "flange", "plug", (0.0, -100.0), (
        Member("torque", "housing.reaction_torque"), Member("force_x", "housing.force_x"), Member("force_y", "housing.force_y"),
    )),
    Terminal("heat", "surroundings: temperature in, lost power out", "heat", "plug", (-60.0, 100.0), (
        Member("temperature", "heat.ambient_temperature"), Member("heat_flow", "heat.power_loss", "outflow"),
    )),
)  # fmt: skip
BUS = (
    "crank.angle", "crank.speed", "output.angle", "cage.angle", "crank.path", "mesh.force_path", "roller.force_path", "mesh.force",
    "roller.force", "heat.contact_temperature", "profile.angle", "mesh.profile_error", "roller.profile_error", "mesh.profile_slope",
    "roller.profile_slope",
)  # fmt: skip
TERMINALS = (
    *MECHANICAL,
    Terminal("wear", "to the wear unit: forces and motion out, profile errors in", "bus", "bus", (60.0, 100.0), tuple(Member(name, name) for name in BUS)),
)
