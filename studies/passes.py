"""Which pass through its hours a life is in, and why it begins again, in the words of terminal and page."""

from studies.life import Life


def before_of(life: Life) -> int:
    """Jumps of the pass before the present one; 0 of the first."""
    if life.coarse:
        return len(life.coarse) - 1
    # After too much wear in one jump the next has twice as many.
    return life.jumps // 2 if life.passes > 1 else 0


def again_line(life: Life, before: int) -> str:
    """Why it begins again after ``before`` jumps."""
    if not life.coarse:
        return f"too much wear in one jump of {before}: again from 0 h, in {life.jumps} jumps"
    return f"again from 0 h in {life.jumps} jumps, each a part of one of the {before} before: the difference is their error"


def pass_of(life: Life) -> str:
    """``pass 2 in 6 jumps``."""
    return f"pass {life.passes} in {life.jumps} jump{'s' * (life.jumps > 1)}"
