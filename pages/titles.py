"""Titles of a picture's axes, on lines that stay within it."""

from textwrap import fill
from typing import Any

from pages.look import Layout
from pages.marks import INCH, SIGN_WIDTH, spelled

# What is left of a plot's height when labels and legend have theirs.
SHARE_OF_AXES = 0.75
# Signs of a line at least.
SHORTEST = 10
# Of a picture's width, what a line keeps from its edges.
MARGIN = 0.01


def title_of(axis: Layout) -> str:
    title = axis.get("title", "")
    return spelled(title.get("text", "") if isinstance(title, dict) else title)


def folded(title: str, axes: Any) -> str:
    """A title beside a plot on lines that are no longer than its axis, the unit on the last, where it is longer itself."""
    room = INCH * axes.figure.get_figheight() * axes.get_position().height * SHARE_OF_AXES
    words, unit = title.rpartition(" [")[::2]
    if len(title) * SIGN_WIDTH <= room:
        return title
    lines = fill(words or title, max(SHORTEST, int(room / SIGN_WIDTH)), break_long_words=False)
    return f"{lines}\n[{unit}" if words else lines


def keep_within(picture: Any, axes: Any) -> None:
    """Fold the title below a plot until none of its lines passes the picture's edge.

    Measured, not counted: its middle is that of the axis, which lies the farther right the more stands beside it.
    """
    lines = axes.get_xlabel().split("\n")
    room = max(len(line) for line in lines)
    picture.draw_without_rendering()
    while room > SHORTEST and (share := share_within(picture, axes)) < 1.0:
        room = min(room - 1, max(SHORTEST, round(room * share)))
        axes.set_xlabel("\n".join(fill(line, room, break_long_words=False) for line in lines))
        # Another line leaves the plot less height, which may change its ticks and with them where the axis begins.
        picture.draw_without_rendering()


def share_within(picture: Any, axes: Any) -> float:
    """Of the width of the title below a plot the part that there is room for, about its middle."""
    box, edge = axes.xaxis.label.get_window_extent(), MARGIN * picture.bbox.width
    middle = 0.5 * (box.x0 + box.x1)
    return float(2.0 * (min(middle, picture.bbox.width - middle) - edge) / box.width) if box.width else 1.0
