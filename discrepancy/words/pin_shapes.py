"""Shapes of the ring of pins as they are found: an oval may be of the pins' own places or of the ring that holds them, and the effect's name says the first."""

from collections.abc import Mapping
from typing import Any

from discrepancy.alike.untold import origins_untold_of
from discrepancy.prediction.physical_model import PhysicalModel

# By variant: the shape, and what a ring is that has it.
SHAPES = {
    "runout": ("a circle off centre", "off centre or clamped so"), "ovality": ("an oval", "oval or clamped so"),
    "trilobe": ("a shape of three lobes", "three-lobed or clamped so"), "harmonics": ("a wavy circle", "wavy or clamped so"),
}  # fmt: skip


def shape_text(effect: Mapping[str, Any], model: PhysicalModel) -> str:
    """``an oval on which the pins of the ring stand (of their own places, or of a ring that is oval or clamped so: not told here)``; empty where the campaign
    tells it, or the effect is another."""
    if effect["name"] != "pin_position_errors" or effect.get("variant") not in SHAPES or not origins_untold_of(effect["parameters"], model.campaign):
        return ""
    shape, ring = SHAPES[effect["variant"]]
    return f"{shape} on which the pins of the ring stand (of their own places, or of a ring that is {ring}: not told here)"
