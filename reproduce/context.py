"""What several claims need, computed once: turns, lives, stiffness tests.

``TOLERANCE`` per jump is coarse on purpose: it moves the figures by a percent and keeps the
command within a minute or two.  ``POSITIONS`` a turn is not: a third of them makes flanks 2 %
deeper, twice as many 0.1 % shallower.
"""

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from orchestrator.settings import Setting, parse_setting
from pages.look import Figure
from reducers.checking import shown
from reducers.completion.complete import complete
from reducers.completion.file import reducer_at
from reducers.completion.given import Given
from reducers.completion.known import known_numbers
from reducers.reducer import Reducer, load_reducer
from reproduce.contacts import Contacts, contacts_of
from studies.hysteresis import LOST_MOTION_SHARE, Hysteresis, hysteresis
from studies.life import Life, LifeSettings, live
from studies.meshing_cycle import run_cycle
from studies.pair import Pair, make_pair
from studies.solve import ARCSEC, record_turn

# Reducers go by their names in the library wherever they are told.  As the two documents have them, on rigid supports and without losses:
BX, RV = "BX-40E-rigid", "RV20E-121-rigid"
# The same as soft, as loose and as lossy as real ones.
REAL_BX, REAL_RV = "BX-40E", "RV20E-121"
# Yang et al., Mech. Mach. Theory 163 (2021) 104384, as in a public repetition of the paper.
RV_80E = ("pin.circle_radius=77.5mm", "pin.radius=4mm", "crank.eccentricity=1.5mm")
MODIFIED = ("disc.equidistant_modification=-13um", "disc.shift_modification=-20um")
RIGID_BEARINGS = ("bearing.clearance=0um", "roller.stiffness=1e8", "numerics.tolerance=1e-6")
STAND, TURN = ("wear.pins=stand",), ()
POSITIONS, TOLERANCE, HOURS, PINS = 72, 0.02, 10_000.0, 40
# At most [h]: statements are looked at from a few hundred hours on.
FIRST_JUMP = 200.0

Made = TypeVar("Made")


@dataclass
class LifeRun:
    """A life and, for each of its recorded hours, contacts and lost motion."""

    pair: Pair
    life: Life
    contacts: list[Contacts] = field(default_factory=list)
    lost_motion_arcsec: list[float] = field(default_factory=list)

    @property
    def hours(self) -> Floats:
        return np.array(self.life.hours)

    def figure(self, name: str) -> Floats:
        """A figure over the recorded hours."""
        return np.array([figures[name] for figures in self.life.figures])

    def tooth(self, hour: int = -1) -> Floats:
        """Mean depth over all teeth [m], by the bins of a lobe from root to root."""
        wear = self.life.surfaces[hour]["disc_wear"]
        lobes = self.pair.reducer.topology.lobes
        return np.asarray(wear.reshape(wear.shape[0] * lobes, -1).mean(axis=0))

    def at(self, hours: float) -> int:
        """Index of the recorded hour nearest to ``hours``."""
        return int(np.abs(self.hours - hours).argmin())


def flank_of(tooth: Floats) -> tuple[Floats, Floats]:
    """(phase [deg, 0 to 180], depth) of the more worn flank of a tooth's bins."""
    half = tooth.size // 2
    phase = 180.0 * (np.arange(half) + 0.5) / half
    first, second = tooth[:half], tooth[: half - 1 : -1]
    return phase, first if first.sum() >= second.sum() else second


class Context:
    """Runs by their settings, each made once."""

    def __init__(self, progress: Callable[[str], None] = lambda _: None, changes: Sequence[str] = ()):
        """``changes``: other numbers than the sources', ``name=value``, of every reducer that has a number of the name."""
        self.progress, self.changes = progress, changes
        # By reducer that was computed with them what it had instead, change by change.
        self.had: dict[str, list[str]] = {}
        self.known: dict[tuple[object, ...], Any] = {}
        # What was asked for since ``reducers_of`` began, and what each of the runs asked for while it was made.
        self.asked: set[str] = set()
        self.asked_by: dict[tuple[object, ...], set[str]] = {}

    def once(self, key: tuple[object, ...], make: Callable[[], Made], text: str = "") -> Made:
        """The value of ``key``, made at the first call."""
        if key not in self.known:
            if text:
                self.progress(text)
            before, self.asked = self.asked, {str(key[1])} if key[0] == "reducer" else set()
            try:
                self.known[key] = make()
            finally:
                self.asked_by[key], self.asked = self.asked, before
        self.asked |= self.asked_by[key]
        made: Made = self.known[key]
        return made

    def reducers_of(self, find: Callable[["Context"], Made]) -> tuple[Made, tuple[str, ...]]:
        """What ``find`` makes, and of which reducers, as the library calls them; runs that are there already are of the same."""
        self.asked = set()
        found = find(self)
        return found, tuple(sorted(self.asked))

    def reducer(self, name: str) -> Reducer:
        """BX and RV as the sources have them, on rigid supports and without losses; REAL_BX and REAL_RV as the library has them."""
        return self.once(("reducer", name), lambda: self.changed(name, load_reducer(name)))

    def changed(self, name: str, reducer: Reducer) -> Reducer:
        """With the other numbers; InputFault for one that it does not have."""
        for text in self.changes:
            if "[" in text.partition("=")[0]:
                raise InputFault(f"--set {text}: single numbers can be changed, not elements of a list")
        own = {one.name: float(one.value) for one in (parse_setting(text, [reducer.plant, reducer.wear]) for text in self.changes)}
        self.had[name] = [stated(reducer, kernel_name) for kernel_name in own]
        return replace(reducer, starts=reducer.starts | own)

    @property
    def altered(self) -> tuple[str, ...]:
        """The changes, each with what the reducers that were computed so far had instead."""
        return self.altered_of(self.had)

    def altered_of(self, names: Collection[str]) -> tuple[str, ...]:
        """The changes, each with what these of the computed reducers had instead."""
        told = (", ".join(f"{name} had {self.had[name][k]}" for name in names) for k in range(len(self.changes)))
        return tuple(f"{change} ({words})" if words else change for change, words in zip(self.changes, told))

    def altered_in(self, figure: Figure) -> tuple[str, ...]:
        """The changes, with what the reducers had that a figure shows: those that its words name, all where these name none."""
        words = " ".join([figure.title, figure.caption, *(str(trace.get("name", "")) for trace in figure.data)])
        return self.altered_of([name for name in self.had if re.search(rf"{re.escape(name)}(?![\w-])", words)] or self.had)

    def rv80e(self) -> Reducer:
        """An RV-80E with ratio 153 and three cranks, completed from what is published of one."""
        given = Given(153.0, PINS, 784.0, 222.0, cranks=3, known=known_numbers(RV_80E))
        return self.once(("reducer", "RV-80E"), lambda: self.changed("RV-80E", reducer_at(complete(given), {}, "RV-80E")))

    def settings(self, name: str, texts: tuple[str, ...]) -> list[Setting]:
        reducer = self.reducer(name)
        return [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]

    def pair(self, name: str, *texts: str, positions: int = POSITIONS) -> Pair:
        """A new pair; not shared."""
        return make_pair(self.reducer(name), self.settings(name, texts), positions=positions)

    def contacts(self, name: str, *texts: str) -> Contacts:
        """Contacts of new parts over a crank turn."""
        return self.once(("contacts", name, texts), lambda: contacts_of(self.pair(name, *texts)))

    def life(self, name: str, *texts: str, hours: float = HOURS, tolerance: float = TOLERANCE,
             positions: int = POSITIONS) -> LifeRun:
        """A life in error-controlled jumps."""
        coarser = f", {positions} positions a turn" if positions != POSITIONS else ""
        label = f"{name}, {hours:.0f} h{coarser}" + (f" ({', '.join(texts)})" if texts else "")
        key = ("life", name, texts, hours, tolerance, positions)
        return self.once(key, lambda: self.lived(name, texts, hours, tolerance, positions), label)

    def lived(self, name: str, texts: tuple[str, ...], hours: float, tolerance: float, positions: int) -> LifeRun:
        run = LifeRun(self.pair(name, *texts, positions=positions),
                      Life(LifeSettings(hours, tolerance, FIRST_JUMP)))

        def keep(life: Life) -> None:
            # A finer run begins anew.
            before = len(life.hours) - 1
            del run.contacts[before:], run.lost_motion_arcsec[before:]
            run.contacts.append(contacts_of(run.pair))
            run.lost_motion_arcsec.append(lost_motion(run.pair))

        live(run.pair, run.life, lambda _: None, keep)
        return run

    def reversing(self, name: str, *texts: str, hours: float = HOURS, parts: int = 8) -> LifeRun:
        """A life of ``parts`` equal jumps in which the torque changes its sign from cycle to cycle."""
        def make() -> LifeRun:
            pair = self.pair(name, *texts)
            run = LifeRun(pair, Life(LifeSettings(hours=hours)))
            torque = pair.plant.number("load_torque")
            for _ in range(parts):
                for sign in (1.0, -1.0):
                    pair.plant.set("load_torque", sign * torque)
                    run_cycle(pair, 0.5 * hours / parts)
            pair.plant.set("load_torque", torque)
            run.life.note(pair)
            return run

        label = f"{name}, {hours:.0f} h with reversing torque" + (f" ({', '.join(texts)})" if texts else "")
        return self.once(("reversing", name, texts, hours, parts), make, label)

    def stiffness(self, name: str, *texts: str) -> Hysteresis:
        """The standard stiffness test."""
        make = lambda: hysteresis(self.reducer(name), self.settings(name, texts))  # noqa: E731
        return self.once(("stiffness", name, texts), make)

    def output_turn(self, name: str, *texts: str, positions: int = 48) -> Floats:
        """Lag of a new reducer over one output turn [arcsec], as the plant's series."""
        def make() -> Floats:
            pair = self.pair(name, *texts, positions=positions)
            pair.wear.set("acceleration", 0.0)
            return ARCSEC * record_turn(pair, positions * pair.reducer.topology.lobes)["lag"].ravel()

        return self.once(("orders", name, texts, positions), make)


def stated(reducer: Reducer, kernel_name: str) -> str:
    """What the reducer has of a number, with the unit that people read."""
    v = next(table.by_name[kernel_name] for table in (reducer.plant, reducer.wear) if kernel_name in table.by_name)
    return v.choices[int(v.start)] if v.choices else shown(reducer, v.path, v.start)


def lost_motion(pair: Pair) -> float:
    """Turning between +3 % and -3 % of the torque at the present wear [arcsec]."""
    saved, torque = pair.master.save(), pair.plant.number("load_torque")
    pair.wear.set("acceleration", 0.0)
    means = []
    for sign in (1.0, -1.0):
        pair.plant.set("load_torque", sign * LOST_MOTION_SHARE * torque)
        means.append(record_turn(pair, pair.positions)["lag"].mean())
    pair.master.restore(saved)
    return float(means[0] - means[1]) * ARCSEC


def amplitude(series: Floats, order: int) -> float:
    """Amplitude of an order per output turn in a record of one output turn."""
    return float(2.0 * abs(np.fft.rfft(series)[order]) / series.size)
