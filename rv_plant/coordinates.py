"""How many coordinates the bodies have; ``assembly`` (at rest) and ``dynamics`` (in motion) say which."""

from fmu_src.variables import Sizes


def coordinate_count(sizes: Sizes) -> int:
    """Length of z: three of each disc, of the carrier and of each crank, and the pin ring's turning."""
    return 3 * sizes["disc"] + 3 + 3 * sizes["crank"] + 1


def moving_count(sizes: Sizes) -> int:
    """Length of q: sun and load besides."""
    return coordinate_count(sizes) + 2
