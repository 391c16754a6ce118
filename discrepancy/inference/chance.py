"""Chances in words."""


def chance(p: float) -> str:
    """``p = 2e-07``; computers run out of digits before nature does."""
    return f"p = {p:.1g}" if p > 1e-300 else "p < 1e-300"
