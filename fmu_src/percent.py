"""A share as text, in percent."""


def percent(share: float, digits: int = 2, sign: str = "") -> str:
    """``100 %`` for 0.998: to ``digits`` significant digits, but never with a power of ten where a share is large; ``sign`` "+" for differences."""
    return f"{float(f'{100.0 * share:.{digits}g}'):{sign}.15g} %"
