"""Amounts of chi-square in words: three digits mean something, ten do not."""


def chi_text(amount: float) -> str:
    """``3.2``, ``8,010``, ``1.46 million``"""
    if abs(amount) < 100.0:
        return f"{amount:.1f}"
    if abs(amount) >= 999500.0:
        millions = amount / 1e6
        return f"{millions:.3g} million" if abs(millions) < 999.5 else f"{millions:,.0f} million"
    rounded = float(f"{amount:.3g}")
    return f"{rounded:,.0f}"
