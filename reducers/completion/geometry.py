"""Whether the parts of a reducer can be made and put together, as the rules of RV reducers have it."""

import math
from collections.abc import Mapping

from reducers.completion.dials import ROLLERS_APART
from reducers.completion.given import GAP, SHIFT, Given
from rv_plant.parts import PLANETS, ROLLERS, PartsFault, check_holes, check_profile, races_apart


def check_geometry(given: Given, values: Mapping[str, float]) -> None:
    """PartsFault names the number, its value in mm, why no reducer has it, and what would do; ``values`` in the units of a completion."""
    ring, pin, eccentricity = values["pin.circle_radius"], values["pin.radius"], values["crank.eccentricity"]
    axis, hole, inner, roller = (values[k] for k in ("crank.circle_radius", "outer_race.radius", "inner_race.radius", "roller.radius"))
    pins, cranks = given.pins, given.crank_count
    planet, sun = given.teeth
    if (sun + planet) * math.sin(math.pi / cranks) <= planet + 2:
        raise PartsFault(
            f"--ratio {given.ratio:g} with --pins {pins} and {cranks} cranks: planets of {planet} teeth around a sun of {sun} overlap;"
            f" give --cranks {cranks - 1}, or look at ratio and pins", PLANETS,
        )  # fmt: skip
    if given.diameter is not None and ring + pin >= 0.5 * given.diameter:
        raise PartsFault(
            f"--diameter {given.diameter:g} mm: a ring of pins of {2.0 * (ring + pin):.4g} mm does not fit inside; give the outer diameter of the housing"
        )
    equidistant, shift = (1e-3 * values[name] for name in (GAP, SHIFT))
    check_profile(pins, ring, pin, eccentricity, equidistant, shift, "--pins")
    check_holes(ring - eccentricity - pin - equidistant, axis, hole, cranks)
    if abs(inner + 2.0 * roller - hole) > 1e-6 * hole:
        raise races_apart(inner, roller, hole)
    pitch = hole - roller
    if inner <= eccentricity or roller > pitch * (1.0 + 1e-9) * math.sin(math.pi / given.rollers - math.radians(0.5 * ROLLERS_APART)):
        raise PartsFault(
            f"roller.radius = {roller:.4g} mm: {given.rollers} rollers do not fit on a circle of {pitch:.4g} mm radius with {ROLLERS_APART:g} degree"
            " between them; give fewer --rollers or smaller ones", ROLLERS,
        )  # fmt: skip
    if values["roller.length"] > values["mesh.width"] * (1.0 + 1e-9):
        raise PartsFault(
            f"roller.length = {values['roller.length']:.4g} mm: longer than the disc is wide (mesh.width = {values['mesh.width']:.4g} mm); give a shorter one"
        )
