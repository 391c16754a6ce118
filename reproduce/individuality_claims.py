"""Deviations of single parts leave their own marks in the wear map.

One full meshing cycle that counts for 50 hours, with one deviation of 3 um at a time; a
mark is the wear over that of ideal parts at the same place.
"""

from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats
from pages.charts import Curve, chart
from pages.look import Figure
from reproduce.claim import INDIVIDUALITY, REPRODUCED, Finding, Number, states
from reproduce.context import RV, Context
from studies.meshing_cycle import run_cycle

HOURS = 50.0
PERCENT = 100.0
UM = 1e6


@dataclass(frozen=True)
class Marks:
    """Wear over that of ideal parts, minus 1 [%]: pins and lobes per disc, raceways (disc, crank)."""

    pins: Floats
    lobes: Floats
    races: Floats
    # Depth of the inner raceways [um], (disc, crank, bin).
    inner: Floats


def worn(context: Context, *texts: str) -> dict[str, Floats]:
    """Wear of each pin, lobe and bearing after a full meshing cycle."""
    def make() -> dict[str, Floats]:
        pair = context.pair(RV, *texts)
        run_cycle(pair, HOURS)
        record, t = pair.wear.record(), pair.reducer.topology
        inner = record["inner_race_wear"][0]
        lobes = record["disc_wear"][0].reshape(t.discs, t.lobes, -1).mean(axis=2)
        return {"pins": record["pin_depth"][0], "lobes": lobes, "races": inner.mean(axis=2), "inner": UM * inner}

    return context.once(("individuality", texts), make, f"{RV}, {', '.join(texts) or 'ideal parts'}")


def marks_of(context: Context, *texts: str) -> Marks:
    ideal, found = worn(context), worn(context, *texts)
    pins, lobes, races = (PERCENT * (found[k] / ideal[k] - 1.0) for k in ("pins", "lobes", "races"))
    return Marks(pins, lobes, races, found["inner"])


def others(values: Floats, *places: tuple[int, int]) -> float:
    """Largest size of all values but those at ``places``."""
    left = np.ones(values.shape, bool)
    for place in places:
        left[place] = False
    return float(np.abs(values[left]).max())


def along(name: str, title: str, values: Floats, what: str) -> Figure:
    """Extra wear over the number of pin or lobe, one curve per disc."""
    numbers = np.arange(values.shape[1]) + 1
    curves = [Curve(f"disc {d + 1}", numbers, row, mode="lines+markers") for d, row in enumerate(values)]
    return chart(name, title, "Wear over that of ideal parts at the same place, minus 1.", curves, what, "[%]", 6, 280)


def around(context: Context, name: str, title: str, marks: Marks) -> Figure:
    """Depth around the inner raceways, one curve per disc and crank, and the ideal one."""
    bins = marks.inner.shape[2]
    angle = 360.0 * (np.arange(bins) + 0.5) / bins
    curves = [Curve(f"disc {d + 1}, crank {c + 1}", angle, marks.inner[d, c])
              for d in range(marks.inner.shape[0]) for c in range(marks.inner.shape[1])]
    curves.append(Curve("ideal", angle, worn(context)["inner"].mean(axis=(0, 1)), "#1d2733", "dot"))
    return chart(name, title, "Inner raceways, from the eccentric direction.", curves, "angle [°]", "depth [µm]", 6, 300,
                 x_axis={"range": [0, 360], "dtick": 60})  # fmt: skip


@states("I01", INDIVIDUALITY, "A proud pin", "A pin 3 µm too thick marks itself, and all lobes evenly, for it meets each.")
def proud_pin(context: Context) -> Finding:
    m = marks_of(context, "errors.pin.radius[3]=3um")
    own, rest = float(m.pins[:, 2].min()), others(m.pins, (0, 2), (1, 2))
    low, high, race = float(m.lobes.min()), float(m.lobes.max()), float(np.abs(m.races).max())
    return Finding(
        REPRODUCED, "The pin carries more on every pass and wears several times faster on both discs. In a full meshing"
        " cycle each lobe passes it once: all lobes wear more, by much the same. Raceways do not notice.",
        [Number("that pin, either disc", "%", own), Number("other pins, largest", "%", rest),
         Number("lobes, least", "%", low), Number("lobes, most", "%", high), Number("raceways, largest", "%", race)],
        [("the pin stands out five times", own > 5.0 * rest), ("all lobes wear more", low > 0.0),
         ("and evenly", high - low < 15.0), ("raceways do not notice", race < 3.0)],
        figures=[along("proud_pin_pins", "Extra wear of the pins", m.pins, "pin"),
                 along("proud_pin_lobes", "Extra wear of the lobes", m.lobes, "lobe")],
    )  # fmt: skip


@states("I02", INDIVIDUALITY, "A pitch error of a lobe", "A lobe displaced by 3 µm towards the load marks its own flank only.")
def pitch_error(context: Context) -> Finding:
    m = marks_of(context, "errors.lobe.pitch[1,5]=-3um")
    own, rest = float(m.lobes[0, 4]), others(m.lobes, (0, 4))
    pins, race = float(np.abs(m.pins).max()), float(np.abs(m.races).max())
    return Finding(
        REPRODUCED, "The lobe takes load from its neighbours at every pin in turn, so its flank wears and no pin stands"
        " out. The other disc is left alone.",
        [Number("that lobe", "%", own), Number("other lobes, largest", "%", rest),
         Number("other disc's lobes, largest", "%", float(np.abs(m.lobes[1]).max())),
         Number("pins, largest", "%", pins), Number("raceways, largest", "%", race)],
        [("the lobe stands out five times", own > 5.0 * rest), ("no pin stands out", pins < 0.1 * own),
         ("raceways hardly notice", race < 5.0)],
        figures=[along("pitch_error_lobes", "Extra wear of the lobes", m.lobes, "lobe")],
    )  # fmt: skip


def bearing_numbers(m: Marks) -> list[Number]:
    races = [Number(f"raceways of disc {d + 1}, crank {c + 1}", "%", float(m.races[d, c]))
             for d in range(m.races.shape[0]) for c in range(m.races.shape[1])]
    return races + [Number(f"flanks of disc {d + 1}", "%", float(m.lobes[d].mean())) for d in range(m.lobes.shape[0])]


def spread(row: np.ndarray) -> float:
    return float(row.max() - row.min())


@states("I03", INDIVIDUALITY, "Throw of one crank eccentric",
        "A throw 3 µm too large on one crank marks the raceways of that eccentric and relieves its disc.")
def crank_eccentricity(context: Context) -> Finding:
    m = marks_of(context, "errors.crank.eccentricity[1,1]=3um")
    discs = m.lobes.mean(axis=1)
    return Finding(
        REPRODUCED, "Disc 1 is pushed off centre by one crank and held by the other: its bearings wear unequally, more at"
        " the faulty eccentric; its flanks and pins wear less. Disc 2 mirrors the bearings through the shared cranks. No single"
        " pin stands out.", bearing_numbers(m),
        [("the faulty eccentric wears more than its disc's other", m.races[0, 0] > m.races[0, 1] + 5.0),
         ("its disc's flanks wear less", discs[0] < -10.0), ("the other disc's hardly", abs(discs[1]) < 5.0),
         ("no pin stands out on its disc", spread(m.pins[0]) < 5.0)],
        figures=[around(context, "eccentricity_races", "One throw 3 µm too large", m)],
    )  # fmt: skip


@states("I04", INDIVIDUALITY, "Phase error of one crank eccentric",
        "An eccentric turned by 3 mrad against its crank moves load from one disc to the other.")
def crank_phase(context: Context) -> Finding:
    m = marks_of(context, "errors.crank.phase[1,1]=0.003")
    discs = m.lobes.mean(axis=1)
    eccentricity = marks_of(context, "errors.crank.eccentricity[1,1]=3um")
    return Finding(
        REPRODUCED, "The error lies along the load: the faulty eccentric hands its load to the same crank's other eccentric. One"
        " disc wears less and the other more by the same, which tells it from an error of the throw.",
        bearing_numbers(m),
        [("the faulty eccentric wears least of all bearings", m.races.argmin() == 0 and m.races[0, 0] < -30.0),
         ("its disc wears less, the other as much more", discs[0] < -10.0 and abs(discs[0] + discs[1]) < 5.0),
         ("several times the mark of the throw",
          np.abs(m.races).max() > 4.0 * np.abs(eccentricity.races).max())],
        figures=[around(context, "phase_races", "One eccentric turned by 3 mrad", m)],
    )  # fmt: skip
