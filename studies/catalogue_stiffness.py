"""A reducer completed so that it is as stiff as its catalogue says: the one number that no rule computes is found by the stiffness test."""

import math
from dataclasses import dataclass, replace

from fmu_src.display import read_text
from fmu_src.faults import InputFault
from fmu_src.units import conversion
from orchestrator.settings import NUMBER, parse_setting
from reducers.completion.complete import Completion, Number, complete
from reducers.completion.doubts import FREE, stiffness_doubt
from reducers.completion.file import reducer_at
from reducers.completion.given import Given
from reducers.reducer import Reducer
from studies.hysteresis import hysteresis
from studies.secants import size_for

# As catalogues round.
NEAR = 1e-3
# Three come as near.
MOST_STEPS = 12
# Times beyond the range of its rule, from which no reducer has a number (assumed: single sizes scatter by a third about the rule).
FAR = 5.0
# Units in which a stiffness is written, and times beyond what rules make of it, up to which another of them explains a number (assumed).
UNIT, ROOM = "N.m/arcmin", 2.0
WRITTEN = (UNIT, "N.m/deg", "kN.m/rad", "N.m/rad")
# Softer ones are none (assumed: a tenth of the softest in catalogues) [N m/arcmin].
LEAST = 0.1


def as_stiff_as(given: Given, stiffness: float, typed: str = "") -> Completion:
    """Completed with crank supports that make the torsional stiffness the catalogue's [N m/arcmin]; ``typed``: as somebody wrote it, with its unit.

    InputFault where no supports make it, or none that are anywhere near those by rules.
    """
    if not LEAST <= stiffness < math.inf:
        raise InputFault(f"--stiffness {stiffness:g} N.m/arcmin: must be {LEAST:g} or more; look at its unit")
    if FREE in given.known:
        raise InputFault(f"--stiffness {stiffness:g} N.m/arcmin and --known {FREE}: each says how soft the crank supports are; keep one")
    by_rules = complete(given)
    number, reducer = by_rules.numbers[FREE], reducer_at(by_rules, {}, "new")
    asked = Asked(stiffness, typed, reducer, number)
    found = compliance_of(asked)
    if not number.low / FAR <= found <= FAR * number.high:
        raise InputFault(beyond_rules(asked, found, given.diameter))
    completion = complete(replace(given, known={**given.known, FREE: found}, stiffness=stiffness))
    doubts = stiffness_doubt(f"{stiffness:g} N.m/arcmin", found, number.low, number.high, number.unit, given.diameter)
    return replace(completion, doubts=[*completion.doubts, *doubts])


@dataclass(frozen=True)
class Asked:
    """A torsional stiffness [N m/arcmin], as it was ``typed``, asked of a reducer whose crank supports are ``by_rules``."""

    stiffness: float
    typed: str
    reducer: Reducer
    by_rules: Number

    @property
    def words(self) -> str:
        """In N.m/arcmin, and before it what was typed in another unit."""
        read = NUMBER.match(self.typed)
        found = f"{self.stiffness:.6g} {UNIT}"
        # As somebody wrote it: N.m, Nm and N·m are one.
        return f"{self.typed.strip()} is {found}" if read and read[2] and not math.isclose(float(read[1]), self.stiffness, rel_tol=1e-9) else found

    def made(self) -> tuple[float, float]:
        """The stiffnesses [N m/arcmin] that supports at either end of their rule make."""
        high, low = (1.0 / turning(self.reducer, end) for end in (self.by_rules.low, self.by_rules.high))
        return low, high

    def meant(self) -> str:
        """The same number in another unit, where the rules make that."""
        read = NUMBER.match(self.typed)
        number, (low, high) = float(read[1]) if read else self.stiffness, self.made()
        others = {unit: number * conversion(unit, UNIT)[0] for unit in WRITTEN}
        found = [unit for unit, value in others.items() if low / ROOM <= value <= ROOM * high and not math.isclose(value, self.stiffness, rel_tol=1e-6)]
        return f"; did you mean {' or '.join(f'{number:g} {unit}' for unit in found)}?" if found else ""


def beyond_rules(asked: Asked, found: float, diameter: float | None) -> str:
    """Why supports of the compliance ``found`` [m/N] are not written: a mistaken unit makes them, no reducer does."""
    number = asked.by_rules
    needed, least, most = (read_text(value, number.unit, 3) for value in (found, number.low, number.high))
    (low, high), meant = asked.made(), asked.meant()
    other = "; give --diameter if the catalogue has it, or look at its unit" if diameter is None else "; look at its unit, and at what else was given"
    return (f"--stiffness {asked.words}: it asks for {FREE} = {needed}, more than {FAR:g} times beyond what rules give, {least} to {most}, which make"
            f" {low:.3g} to {high:.3g} {UNIT}{meant or other}")  # fmt: skip


def compliance_of(asked: Asked) -> float:
    """Of the crank supports [m/N], by secants from rigid ones and the usual ones on: the turning is nearly straight over it."""
    reducer, usual, turned = asked.reducer, asked.by_rules.value, turning(asked.reducer, 0.0)
    if turned >= 1.0 / asked.stiffness:
        raise InputFault(
            f"--stiffness {asked.words}: with rigid crank supports the other numbers make it {1.0 / turned:.4g} {UNIT}, which is softer"
            + (asked.meant() or "; look at the unit, or give what makes them stiffer: --diameter, --known mesh.width=..., carrier.compliance=...,"
               " first_stage.compliance=...")
        )  # fmt: skip
    met = size_for(1.0 / asked.stiffness, lambda size: turning(reducer, size), (0.0, turned), (usual, turning(reducer, usual)), NEAR, MOST_STEPS)
    if not met.near:
        raise InputFault(f"--stiffness {asked.words}: no {FREE} makes it, {1.0 / met.figure:.4g} {UNIT} is the nearest; look at its unit")
    return met.size


def turning(reducer: Reducer, compliance: float) -> float:
    """Per torque [arcmin/(N m)]."""
    setting = parse_setting(f"{FREE}={compliance!r}", [reducer.plant, reducer.wear])
    return 1.0 / hysteresis(reducer, [setting]).stiffness_Nm_per_arcmin
