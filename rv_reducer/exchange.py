"""What plant and wear unit exchange, by the names that both have for it.

A master connects the two units by this list; the unit of both lays what they exchange into the
same cells.  All are values at the communication point or running totals, so none depends
on the communication step.
"""

PLANT_TO_WEAR = (
    "crank.angle", "crank.speed", "output.angle", "cage.angle", "crank.path", "mesh.force_path", "roller.force_path",
    "heat.contact_temperature",
)  # fmt: skip
WEAR_TO_PLANT = ("profile.angle", "mesh.profile_error", "roller.profile_error", "mesh.profile_slope", "roller.profile_slope")
