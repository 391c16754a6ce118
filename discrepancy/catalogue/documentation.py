"""The page docs/effects.md: every effect with its law, parameters, and computed signature.

    python -m discrepancy.catalogue.documentation
"""

from collections.abc import Mapping
from pathlib import Path

from discrepancy.campaign.documentation import table
from discrepancy.catalogue.catalogue import Entry, entries
from discrepancy.catalogue.examples import AUDITED
from discrepancy.catalogue.ranges import range_of
from discrepancy.catalogue.signal_words import words
from discrepancy.catalogue.signature import SURFACES, Signature, largest, new_bench, number, signature
from rv_plant.effects import ALLOWED as PLANT_ALLOWED
from rv_plant.effects import HOOKS as PLANT_HOOKS
from rv_plant.variables import own_variables as plant_variables
from wear_fmu.effects import ALLOWED as WEAR_ALLOWED
from wear_fmu.effects import HOOKS as WEAR_HOOKS
from wear_fmu.variables import own_variables as wear_variables

PAGE = Path(__file__).resolve().parents[2] / "docs" / "effects.md"
COMPUTED = "**Computed**"
# Rows of a table; the rest is in ``rvwear effects NAME``.
MOST_ROWS = 10
DEPTH = " depth"
HEAD = """# Effects

Made by `python -m discrepancy.catalogue.documentation`. What a real reducer and its sensors may do beyond the ideal
model: one file each, compiled into the units, off by default (then figures are the same to the last bit).
*Expected* is the signature that physics demands, *computed* what the virtual bench shows for RV20E-121-rigid (rigid supports, no losses; quasi-static, radial
needle clearance 2.5 um, rated 167 N m, 2000 rpm of the input): figure without and with the effect, the largest changes first
in the order of the bench. Orders are those of one turn of the output, wear after 1,000 h at rated speed or as many
turns. `TE` is the transmission error, `mean TE (behind)` its mean, taken negative. `rvwear effects NAME` shows all figures,
`rvwear effects --html FILE` pictures.
"""
# When the units call the hooks.
STAGES = {
    "start": "once, at initialisation: own states",
    "prepare": "at initialisation, and whenever an amplitude is set during a run: what holds for the whole run",
    "warm": "before every equilibrium (in motion: every internal step): temperature",
    "before": "after that: what depends on angle and temperature",
    "hold": "in every iteration of an equilibrium (not in motion): forces and their tangent",
    "after": "when the contact forces are known: losses, vibration",
    "advance": "at the end of a step of `duration` [s]: own states",
    "heat": "after that: the temperature reached",
    "factor": "for every contact, if any effect added 1 to `effects_on`: returns the factor on the wear coefficient, 1.0 where it is off;"
    " for the surfaces that `NAME_surfaces` (NAME: the effect's file) chooses, a parameter that every effect with a factor gets",
}
# The rate that belongs to a field.
RATES = {"tooth_gap": "tooth_gap_rate", "tooth_play": "tooth_play_rate", "crank_turn_added": "crank_turn_rate"}
# Work arrays, which have no description where they are declared.
MORE = {
    "residual_vector": "forces and moments that must vanish, by coordinate of `z` (see `rv_plant/assembly.py`), N or N m: what resists counts positive",
    "tangent": "their derivatives by the coordinates of `z`",
}  # fmt: skip
OWN = """## Your own effect

A file in a folder `DIR/rv_plant/` (what happens in the reducer) or `DIR/wear_fmu/` (how it wears), and `RVWEAR_EFFECTS=DIR` in the
environment: it is compiled into the units, stands in this catalogue, and the diagnosis looks for it. `DIR/rv_plant/soft_ring.py`:

```python
\"\"\"Pin ring in a soft seat: it turns under its torque, more when warm.  Source: own measurement.\"\"\"

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.mesh import ring_coordinate

EFFECT = Effect(
    0, "soft ring", "turning = c M", "own measurement", "linear in torque, both ways",
    (
        amplitude("seat_compliance", "rad/(N.m)", "c", 1e-7, 0.0, 1e-2, sign=1),
        shape("seat_growth", "1/K", "growth of the pin circle with it", 1e-6, 0.0, 1e-4, "assumed", held=True),
    ),
    signals=("hysteresis", "lost_motion"),
)


@kernel
def prepare(r):
    r.compliance[ring_coordinate(r)] += r.seat_compliance


@kernel
def before(r):
    if r.seat_compliance > 0.0:
        r.ring_scale *= 1.0 + r.seat_growth * (r.reducer_temperature - 293.15)
```

`rvwear effects --check FILE` says what is wrong with it, with file and line; every command that uses it says the same before
anything is compiled. Kernels call a parameter by the name that the file gives it, tools and files `effects.soft_ring.seat_compliance`, without
leading words that the effect's name has too. An effect must vanish at its amplitudes' off values.

The name of a parameter or a state must be free: no variable of the unit, no array of its kernels (these stand on no page) and no parameter of another
effect, one's own others included, may have it. `rvwear effects --check` says of a name that is taken who has it. One that begins with the file's name,
as `soft_ring_direction`, is hardly ever taken.

A diagnosis fits amplitudes and shapes together, each within its bounds. It looks for a shape at the values of `grid=(...)` first (without:
start, a third and three times of it; quarters of a turn for an angle that may go all round) and goes on from the best of them. A number that
measurements cannot show, or that is known, says `held=True`: it stays at its start, and every answer says so. `rvwear effects --check` has
a line for each parameter: its unit, the one that answers give it in, and whether it is fitted, within which bounds. A file's unit is SI,
because kernels get the number as it stands; answers, pages and the model files of `extend` write the field's (arcmin/(N.m) for rad/(N.m),
rpm for rad/s, um for m; for rad, by the size, deg, arcmin or arcsec), always with the unit beside the number, and JSON has the SI value as `si`, too.

Kernels call kernels (of the file, or imported from `rv_plant`, `wear_fmu` and `fmu_src`), the functions of `math` (`import math` at the head
of the file) and abs, min, max, int, float, bool and len; numpy and other modules do not reach machine code and FMUs.

`signals=` names the measured quantities in which the effect shows, by these words; a diagnosis looks for it in campaigns that measure one of them,
and in all campaigns where none is named:

SIGNALS

The hooks, kernels of these names, are called
at these stages, each of them for all effects before the next begins:

STAGES

What `prepare` changes stands until an amplitude is set again; an input that it reads (`r.load_torque`, `r.input_speed`) would be that of the start,
and is refused: a law that follows the load adds a force in `hold` or changes a gap in `before`. A stiffness (`mesh_constant`, `pin_stiffness`,
`roller_constant`) can so depend on the temperature of the surroundings at the start of a run (`r.temperature`), as the conditions of a campaign
state it, each of which is a run of its own; a temperature that changes during a run (`reducer_temperature`) acts through what `before` changes,
gaps and the ring's size, and leaves stiffnesses as they were.

Each of the fields, by what its indices count. Places and directions are those of a drawing with the ring's centre at the origin and
angles counter-clockwise, at output angle 0; a disc's lobes are counted in its own frame.

FIELDS

A kernel gets how many discs, cranks, rollers or pins there are from a field that they index, and runs over each index in a loop of its own:

```python
@kernel
def before(r):
    for disc in range(r.roller_gap_now.shape[0]):
        for crank in range(r.roller_gap_now.shape[1]):
            for roller in range(r.roller_gap_now.shape[2]):
                r.roller_gap_now[disc, crank, roller] += r.loosening
```

What changes with the angle has a rate beside it, which bodies in motion (`numerics.fidelity = "dynamic"`) need: an effect that adds to a
gap, a play or a crank's turning sets both, or its teeth close without a speed, and the damping of their contact is wrong;
`fall_back(r, lag, rate)` of `rv_plant.gear_stage` sets all four for an output that falls back. Equilibria read `crank_turn_rate`
alone, for the drive torque. What turns the cranks shows in `output.transmission_error`, which counts from the input, and not in `output.lag`,
which counts from where the cranks stand.

Within a stage effects add (`+=`, `-=`) or multiply (`*=`, `/=`) and read nothing that others change there, so that neither the
order of the effects nor their names matter. An effect sets (`=`) its own states alone (`states=` of `EFFECT`), at any stage but `hold` and
`factor`. It may read everything else of the record ([variables](variables.md), and the states that the files in `rv_plant/` declare),
and call kernels of its own and of `rv_plant` that keep to the same rules. Crank seats, main bearing and pin ring take what is added to
`compliance` at rest and in motion, the teeth of the first stage (turning of the cranks) at rest alone.
"""
AUDIT_HEAD = """## Against the physics audit

Figures of an independent solver. It gives the lag of the second stage where the bench gives the transmission error of the
whole reducer, 2 to 4 % smaller. The audit's proud pin stands inwards, here it is thicker, which takes more gap;
random places are other random numbers; worn races are its wear print, here a smooth hollow.

"""


def own_part() -> str:
    """How to write an effect; the stages with what may be changed there, from the units' own tables."""
    rows = []
    for part, hooks, allowed in (("plant", PLANT_HOOKS, PLANT_ALLOWED), ("wear unit", WEAR_HOOKS, WEAR_ALLOWED)):
        for name, (arguments, _) in hooks.items():
            by = {operator: [f"`{f}`" for f, o in allowed[name].items() if o == operator] for operator in ("+=", "*=")}
            rows.append((part, f"`{name}({arguments})`", STAGES[name], ", ".join(by["+="]) or "-", ", ".join(by["*="]) or "-"))
    stages = table(("unit", "hook", "called", "adds to", "multiplies"), rows)
    return OWN.replace("STAGES\n", stages).replace("FIELDS\n", field_table()).replace("SIGNALS\n", signal_table())


def signal_table() -> str:
    rows = [(f"`{word}`", ", ".join(f"`{q}`" for q in quantities), meaning) for word, (meaning, quantities) in words().items()]
    return table(("word", "of a campaign's quantities", "what is measured"), rows)


def field_table() -> str:
    """Every field that a hook may change: unit, what its indices count, meaning with sign and place, and the hooks."""
    rows = []
    for own, allowed in ((plant_variables, PLANT_ALLOWED), (wear_variables, WEAR_ALLOWED)):
        known = {v.name: v for v in own()}
        fields = dict.fromkeys(f for changes in allowed.values() for f in changes if f in known)
        for field in fields:
            v = known[field]
            hooks = ", ".join(f"`{hook}`" for hook, changes in allowed.items() if field in changes)
            operator = next(changes[field] for changes in allowed.values() if field in changes)
            meaning = MORE.get(field, v.description) + (f"; its rate: `{RATES[field]}`" if field in RATES else "")
            indexed = f"{field}[{', '.join(v.axes)}]" if any(v.axes) else field
            rows.append((f"`{indexed}`", f"{operator} in {hooks}", "" if v.unit == "1" else v.unit, meaning))
    return table(("field", "how, where", "unit", "meaning"), rows)


def static_part(entry: Entry) -> str:
    """Title, law, source, expectation and parameters."""
    e = entry.effect
    parameters = [
        (f"`{p.variable.path}`", p.told_kind, *range_of(p), p.variable.description) for p in e.parameters
    ]  # fmt: skip
    heads = ("parameter", "kind", "unit", "off or start", "bounds", "meaning")
    return "\n".join((
        f"## {entry.number}. {e.title}" if e.number else f"## {e.title}", "",
        f"`{entry.name}`, acts in the {entry.part}.", "", f"**Law:** {e.law}", "", f"**Source:** {e.source}", "",
        f"**Expected:** {e.signature}", "", table(heads, parameters),
    ))  # fmt: skip


def computed_part(entry: Entry, found: list[Signature]) -> str:
    """Per case the figures that change, and for effects of the wear unit how much faster which surface wears."""
    parts = []
    for s in found:
        wears = "wear" in entry.part
        rows = [(r.figure, r.condition, *r.texts, "" if r.unit == "1" else r.unit)
                for r in largest(s, MOST_ROWS, DEPTH if wears else "")]
        shown = [table(("figure", "condition", "without", "with", "unit"), rows)] if rows else []
        shown += [wear_table(s)] if wears else []
        parts.append(f"{COMPUTED}, {s.case.title}:\n\n" + "\n".join(shown or ["nothing that the bench measures changes\n"]))
    return "\n".join(parts)


def wear_table(s: Signature) -> str:
    """Depth with over depth without the effect, by condition and surface."""
    rows: dict[str, list[str]] = {}
    for r in s.rows:
        if r.figure.endswith(DEPTH):
            rows.setdefault(r.condition, []).append(f"{r.present / r.without:.2f}")
    return table(("wear with / without", *(name.replace("_", " ") for name in SURFACES)), [(c, *ratios) for c, ratios in rows.items()])


def audit_table(found: Mapping[str, list[Signature]]) -> str:
    """Computed figures beside those of the physics audit."""
    rows = []
    for name, case, figure, condition, audited in AUDITED:
        row = found[name][case].row(figure, condition)
        rows.append((f"`{name}`", found[name][case].case.title, figure, condition, number(row.present), number(audited), row.unit))
    return AUDIT_HEAD + table(("effect", "case", "figure", "condition", "here", "audit", "unit"), rows)


def page(found: Mapping[str, list[Signature]]) -> str:
    parts = [f"{static_part(e)}\n{computed_part(e, found[e.name])}" for e in entries()]
    return "\n".join((HEAD, own_part(), *parts, audit_table(found)))


def main() -> None:
    bench = new_bench()
    found = {e.name: [signature(bench, e.name, case) for case in e.cases] for e in entries()}
    PAGE.write_text(page(found), encoding="utf-8")


if __name__ == "__main__":
    main()
