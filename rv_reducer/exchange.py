"""What plant and wear unit exchange, as (source, target).

A master connects the two units by this list; the unit of both lays each pair into the
same cells.  All are values at the communication point or running totals, so none depends
on the communication step.
"""

PLANT_TO_WEAR = [
    *((name, name) for name in (
        "crank_angle", "crank_speed", "output_angle", "cage_angle", "crank_path", "mesh_force_path", "roller_force_path",
    )),
    ("reducer_temperature", "temperature"),
]  # fmt: skip
WEAR_TO_PLANT = [
    (name, name) for name in (
        "profile_angle", "mesh_profile_error", "roller_profile_error", "mesh_profile_slope", "roller_profile_slope",
    )
]  # fmt: skip
