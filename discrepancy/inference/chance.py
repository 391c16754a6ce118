"""How often chance makes as much, in words: the one way in which p is printed, on screen, pages and in the workbench."""

# From here on p stands with its decimals, below it as a power of ten.
WITH_DECIMALS = 1e-3
# Computers run out of digits before nature does.
LEAST = 1e-300


def chance_number(p: float) -> str:
    """``0.26``, ``0.90``, ``1``, ``0.035``, ``2e-7``."""
    if p <= LEAST:
        return f"< {LEAST:g}"
    if p >= 0.1:
        # Below each other 0.87, 0.9 and 0.92 look rounded in two ways.
        return f"{p:.2f}".replace("1.00", "1")
    if p >= WITH_DECIMALS:
        return f"{p:.2g}"
    mantissa, power = f"{p:.0e}".split("e")
    return f"{mantissa}e{int(power)}"


def chance(p: float) -> str:
    """``p = 2e-7``."""
    return f"p {chance_number(p)}" if p <= LEAST else f"p = {chance_number(p)}"
