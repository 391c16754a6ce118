"""Units of figures, which their names end in, ``peak_pin_force_N``, and what a figure is that others read otherwise."""

# Unit and meaning of the figures' name endings.
FIGURE_UNITS = {
    "_N": "N", "_Nm": "N.m", "_MPa": "MPa", "_arcsec": "arcsec", "_um": "um", "_deg": "deg", "_mm_s": "mm/s", "_s": "s",
    "_per_arcmin": "N.m/arcmin", "_arcmin": "arcmin", "_percent": "%", "_Hz": "Hz", "_Nm_arcmin": "N.m.arcmin",
}  # fmt: skip
# Two stiffnesses of one reducer: what friction holds is none of the running one's.
RUNNING = "stiffness: running, between half and all of the torque; with the input held, rvwear hysteresis"
HELD = "stiffness: input held, loading, between half and all of the torque; running, rvwear solve"
HELD_IN_LIVES = "lost motion: input held, mean over a crank turn, as rvwear hysteresis reads it"
# Two widths of one loop likewise.
WIDTHS = "loop width: at no torque, the way through the clearances in it; its mean between 3 % and half of the torque is what rvwear compare shows"

# Two transmission errors of one turn likewise, whose names tell them apart only to who knows that there are two.
WHICH_ERROR = {"transmission_error_pp_arcsec": "second stage alone, against the cranks", "transmission_error_at_input_pp_arcsec": "whole, against the input"}

# The third is what a life tells: of errors that are fixed to the ring one crank turn shows what lies where the output then stands.
OVER_TURN = "transmission_error_over_turn_pp_arcsec"
WINDOW = "over one crank turn, where the output then stands"
WHAT_IS_OVER_TURN = "transmission error, peak to peak: over one turn of the output; force, teeth, lag and stiffness: " + WINDOW
OF_LIVES = {name: f"transmission error peak to peak, {which}, {WINDOW}" for name, which in WHICH_ERROR.items()} | {
    OVER_TURN: "transmission error peak to peak, whole, against the input, over one turn of the output; between first and last hour as the jumps show it",
    "lost_motion_arcmin": HELD_IN_LIVES,
}  # fmt: skip


def figure_unit(name: str) -> str:
    """Unit of a figure, from the ending of its name; "1" if it has none."""
    endings = [ending for ending in FIGURE_UNITS if name.endswith(ending)]
    return FIGURE_UNITS[max(endings, key=len)] if endings else "1"
