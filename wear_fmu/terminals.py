"""Where a plant takes hold of the wear unit: the bus."""

from fmu_src.terminals import Member, Terminal

BUS = (
    "crank.angle", "crank.speed", "output.angle", "cage.angle", "crank.path", "mesh.force_path", "roller.force_path", "mesh.force",
    "roller.force", "heat.contact_temperature", "profile.angle", "mesh.profile_error", "roller.profile_error", "mesh.profile_slope",
    "roller.profile_slope",
)  # fmt: skip
TERMINALS = (
    Terminal("plant", "to the plant: forces and motion in, profile errors out", "bus", "bus", (-100.0, 0.0), tuple(Member(name, name) for name in BUS)),
)
