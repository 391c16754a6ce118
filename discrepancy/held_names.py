"""Quantities measured with one side held, and the factor that says where that was: alone, for what must start at once."""

HELD, LOCKED_AT = ("hysteresis", "lost_motion", "torsional_stiffness"), "locked_at"
# The effect that stands for a position of which nobody says it.
LOCKED_POSITION = "locked_position"
