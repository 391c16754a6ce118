"""Hours between inspections, cut into what one wear cycle of the bench can stand for."""

import math
from collections.abc import Iterator

from studies.life import HOUR

# Hours that count as none [s].
NOTHING = 1e-6 * HOUR
# Longest and first stretch of hours that one wear cycle stands for.
LONGEST_JUMP, FIRST_JUMP = 1000.0 * HOUR, 50.0 * HOUR


def stretches(inspections: list[float]) -> Iterator[tuple[float, float, float]]:
    """What the wear cycles of a life stand for: (time before, length, inspection it leads to) [s], growing in length."""
    done, jump = 0.0, FIRST_JUMP
    for target in sorted(set(inspections)):
        while target - done > NOTHING:
            left = target - done
            stretch = left / max(1, math.ceil(left / jump - 1e-9))
            yield done, stretch, target
            done += stretch
            jump = min(LONGEST_JUMP, 2.0 * jump)
