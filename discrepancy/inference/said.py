"""What a diagnosis says on the way, before there is an answer."""

from discrepancy.inference.chance import chance
from discrepancy.inference.misfit.localise import Localisation


def misfit_text(found: Localisation) -> str:
    """Where the misfit is: ``misfit: transmission_error, orders: crank against carrier, everywhere alike (p = 1e-25), and 2 more``"""
    if not found.largest:
        return "no place, order or dependence carries a significant misfit"
    best, more = found.largest[0], f", and {len(found.largest) - 1} more" if len(found.largest) > 1 else ""
    where = "everywhere alike" if best.dependence == "everywhere" else f"changing with {best.dependence}"
    return f"misfit: {best.signal}, {best.feature}, {where} ({chance(best.p)}){more}"
