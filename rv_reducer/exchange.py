"""What plant and wear unit exchange, as (source, target).

A master connects the two units by this list; the unit of both lays each pair into the
same cells.
"""

PLANT_TO_WEAR = [
    *((name, name) for name in ("crank_angle", "crank_speed", "output_angle", "cage_angle", "mesh_force", "roller_force")),
    ("reducer_temperature", "temperature"),
]
WEAR_TO_PLANT = [(name, name) for name in ("mesh_profile_error", "roller_profile_error")]
