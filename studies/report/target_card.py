"""The card of a figure of the catalogue: what the stiffness test reads, beside what was asked for."""

from pages.content import Card
from studies.catalogue_targets import Target


def target_card(target: Target) -> Card:
    missed = "" if target.is_met else f", {target.miss_words}"
    unit, tone = target.unit.replace("N.m", "N·m"), "plain" if target.is_met else "fair"
    return Card(target.name, f"{target.reached:.3g}", f"{target.asked:g} of the catalogue{missed}", unit=unit, tone=tone)
