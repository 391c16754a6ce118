"""The card of a figure of the catalogue: what the stiffness test reads, beside what was asked for."""

from fmu_src.unit_words import unit_on_screen
from pages.content import Card
from studies.catalogue_targets import Target


def target_card(target: Target) -> Card:
    missed = "" if target.is_met else f", {target.miss_words}"
    unit, tone = unit_on_screen(target.unit), "plain" if target.is_met else "fair"
    return Card(target.name, f"{target.reached:.3g}", f"{target.asked:g} of the catalogue{missed}", unit=unit, tone=tone)
