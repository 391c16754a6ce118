"""The reducer's model of a campaign, as the statistics wants it (``problem.Model``)."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from discrepancy.campaign.doubts import impossible_torque
from discrepancy.campaign.model import ENCODER_PHASE, Campaign
from discrepancy.model_file import ModelFile, every_effect
from discrepancy.outlying_samples import bridged, marked
from discrepancy.prediction import model_error
from discrepancy.prediction.angle_zeros import angle_zeros
from discrepancy.prediction.apart import apart
from discrepancy.prediction.base_numbers import base_numbers
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.by_effects import Effects
from discrepancy.prediction.cages import Cages
from discrepancy.prediction.candidates import candidates
from discrepancy.prediction.chain import Chain
from discrepancy.prediction.conditions import LAG_SHARE, Values, angles_of, at_rest, distinct_conditions, identity
from discrepancy.prediction.defined_samples import defined
from discrepancy.prediction.even_angles import with_even_angles
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.lags import Lags
from discrepancy.prediction.lives import WHOLE_SWEEP
from discrepancy.prediction.locked_places import LockedPlaces
from discrepancy.prediction.locked_waves import LockedWaves
from discrepancy.prediction.model_error import LOOPS, with_error
from discrepancy.prediction.nuisances import HOUSING_MASS, expanded, require_known
from discrepancy.prediction.observe import CHANGES, COARSE_CHANGES, OBSERVED, Changes
from discrepancy.prediction.order_curves import curve_of, orders_shown
from discrepancy.prediction.over_angle import glimpsed_angles, glimpsed_error
from discrepancy.prediction.over_torque import loop_error
from discrepancy.prediction.placed_beside import PlacedBeside
from discrepancy.prediction.stations import shared_stations
from discrepancy.prediction.unstated_places import UnstatedPlaces, is_from_there, locked
from discrepancy.prediction.zero_bounds import zero_bounds
from discrepancy.problem import ERROR, ORDERS, Candidate, Parameter, Record, is_loop
from discrepancy.repetitions import outlying, with_left_out
from fmu_src.arrays import Floats
from fmu_src.faults import RunFault
from fmu_src.threads import Threads

# Bounds of the output's lag, of the base model's: real reducers are up to ten times as soft as those on rigid supports; none where it was the input's angle.
LAGS = (0.0, 12.0)
# What is known of it beforehand, as a standard deviation (assumed): wide, for two loads tell it.  One load tells it and the angle's zero together: they go
# nowhere then, and an input that was locked stays where it was.
LAG_KNOWN = 3.0
# Error, over the size of the quantity, of values that are impossible.
IMPOSSIBLE = 100.0
# Kept predictions: those of one call, of all its runs that repeat each other.
MOST_SHOWN = 200

# Orders are those of the curve.
PREDICTED = {*OBSERVED, ORDERS}

PLACES_ENCODER = "lag of the output under load, in times that of the base model: it places the angle of an encoder on the output, and tells no stiffness"


@dataclass(frozen=True)
class Asked:
    """Values of everything for which is predicted: ``of_reducer`` what a reducer knows of, ``acting`` the effects of the measuring chain, ``effects``
    by their amplitudes all that are on."""

    values: Values
    of_reducer: dict[str, float]
    acting: list[str]
    effects: Effects


class PhysicalModel(PlacedBeside):
    """Predicts a campaign's records with the compiled kernels, or by the FMUs of the folder ``fmus``.

    ``unpredicted`` lists quantities that it has no prediction for; their records are left out.  ``outlying`` are all repetitions that stand out.
    """

    def __init__(self, model: ModelFile, campaign: Campaign, zeros: Mapping[str, float] | None = None,
                 jobs: int = 1, fmus: Path | None = None):
        # An FMU is stepped by one.
        self.file, self.campaign, self.threads = model, campaign, Threads(1 if fmus else jobs)
        shown = [r for r in campaign.records if r.quantity in PREDICTED]
        # Told by all that was measured, as a check of the campaign does.
        self.outlying = outlying(campaign.records)
        self.records: list[Record] = with_left_out(with_even_angles(marked([defined(r, campaign) for r in shown])), self.outlying)
        self.unpredicted = sorted({r.quantity for r in campaign.records} - PREDICTED)
        present = model.values()
        self.bench = bench_of(model, present, fmus)
        self.bench.fineness, self.bench.threads = Fineness(self.records), self.threads
        errors = [r for r in self.records if r.quantity == ERROR and {"angle", "time"} & r.axes.keys()]
        self.bench.stations = shared_stations(errors, lambda record: angles_of(self.bench, record, 0.0))
        for effect in every_effect().values():
            shapes = {p.variable.name for p in effect.parameters if p.kind == "shape"}
            self.bench.fineness.shapes |= shapes
            self.bench.fineness.steep |= shapes if effect.rolled_over else set()
        for record in self.records:
            rows = distinct_conditions(self.bench, record)
            # A held test looks at a life under the rated load.
            self.bench.plan([*rows, *(at_rest(self.bench, c) for c in rows)], record.held_out)
        if not any(r.tags.get("surface") == "pin" for r in self.records):
            self.bench.largest_sweep = WHOLE_SWEEP
        self.rough_bench = self.bench.rougher
        self.chain = Chain(self.bench, present)
        self.sizes = {q: typical_size([r for r in self.records if r.quantity == q and not r.left_out]) for q in {r.quantity for r in self.records}}
        if ORDERS in self.sizes:
            self.sizes.setdefault(ERROR, self.sizes[ORDERS])
        nuisances = [n for n in campaign.nuisances if n.parameter.name != ENCODER_PHASE]
        require_known(campaign.folder, nuisances, self.bench.tables)
        self.per = {n.parameter.name: n.per for n in nuisances}
        self.zeros: dict[str, float] = dict(zeros or {})
        self.zero_bounds = zero_bounds(campaign.nuisances)
        # One wave of the pattern in the transmission error that says where angles count from [rad of the output]: discs take turns at the pins.
        self.discs = model.reducer.topology.discs
        self.wave = 2.0 * np.pi / (model.reducer.topology.pins * self.discs)
        declared = tuple(p for n in nuisances for p in expanded(n, self.records))
        self.declared = declared
        # No FMU can be told where its cages stand; what they change is the same in process.
        in_process = Bench(model.reducer, present) if fmus else self.bench
        self.lags = Lags(self.bench, self.records)
        self.cages = Cages(in_process, self.records, self.as_seen, self.threads)
        self.identities = identities_of(self.records)
        self.shown: dict[Hashable, Floats] = {}
        # Amplitudes of the file's own effects where these are off.
        off = {p.variable.name: p.variable.start for effect in every_effect().values() for p in effect.amplitudes()}
        self.without_own = {name: off[name] for name, value in present.items() if off.get(name, value) != value}
        if zeros is None:
            always, known = len(nuisances) < len(campaign.nuisances), model.zeros_of(campaign.name) if self.without_own else None
            self.zeros = angle_zeros(self.bench, self.records, self.wave, self.for_record, self.standing(), always, known, self.zero_bounds)
        # Where an input was locked is counted as the angles of its mounting; how the pattern lies tells that well enough.
        for bench in (self.bench, in_process):
            bench.zeros.update(self.zeros)
        self.locked_places = LockedPlaces(self.records, self.zeros, self.bench.ratio)
        turn = 2.0 * np.pi * abs(self.bench.ratio)
        self.locked_waves = LockedWaves(self.records, list(self.zeros), self.wave * abs(self.bench.ratio), self.discs)
        self.unstated_places = UnstatedPlaces(self.records, turn, turn / model.reducer.topology.pins)
        self.search_bench = in_process.rougher.forgetful()
        if zeros is None:
            self.cages.place(self.standing())
            self.place_unstated(frozenset(), self.standing(), bool(model.zeros_of(campaign.name)))
        self.nuisances: tuple[Parameter, ...] = declared + tuple(self.angle_nuisances())
        if any(r.quantity.startswith("vibration") for r in self.records) and HOUSING_MASS not in self.per:
            # Assumed, and known to be of that size: else any force would do, with a mass to match.
            self.nuisances += (Parameter(HOUSING_MASS, "kg", 10.0, 1.0, 1e3, 1.0, 0, 10.0, "mass that vibrates"),)
        self.nuisances += (*model_error.parameters(self.records), *self.unstated_places.parameters())
        excluded = {n.parameter.name for n in nuisances}
        mountings = sorted({r.mounting for r in self.records if r.quantity in (ERROR, ORDERS)})
        topology = model.reducer.topology
        self.candidates: tuple[Candidate, ...] = candidates(
            self.records, present, excluded, mountings, topology.output_pins, topology.cranks, topology.pins, topology.ways,
        ) + tuple(base_numbers(model.reducer, present.keys() | excluded))
        self.cages.amplitudes = {p.name: p.off for c in self.candidates for p in c.amplitudes}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Records that come back from a file are other objects: another may have the address that one of them had."""
        self.__dict__.update(state)
        self.identities = identities_of(self.records)

    def angle_nuisances(self) -> list[Parameter]:
        found = [
            Parameter(name, "rad", zero, *self.zero_bounds.of(zero, (self.discs - 0.5) * self.wave), 1e-3, 0, None,
                      "output angle of the model at the record's angle 0")
            for name, zero in self.zeros.items()
        ]  # fmt: skip
        if any(r.of_output for r in self.records):
            found.append(Parameter(LAG_SHARE, "1", 1.0, *LAGS, 0.05, 0, LAG_KNOWN, PLACES_ENCODER))
        return found

    def predict(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> list[Floats]:
        """See ``problem.Model``."""
        return self.shared(range(len(self.records)) if which is None else which, self.asked(values))

    def predict_beside(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], roughly: bool = False) -> list[Floats]:
        """``predict`` for values next to ``base``, to first order where that is cheaper: for sensitivities."""
        return self.shared(which, self.asked(values), self.asked(base), roughly)

    def predict_near(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        """``predict`` with errors of a few parts in a hundred of what ``values`` change next to ``base``, where that is cheaper."""
        return self.shared(which, self.asked(values), self.asked(base), changes=COARSE_CHANGES)

    def predict_roughly(self, values: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        """``predict`` with errors of a few parts in a hundred of what is changed: for searches."""
        return self.shared(which, self.asked(values), rough=True)

    def glimpse(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], first_order: bool) -> Floats:
        """See ``problem.Glimpsing``: a transmission error at some angles, all else at its samples, under most and least load."""
        high, low = self.asked(values), self.asked(base)
        chosen: dict[str, Record] = {}
        for record in sorted((self.records[i] for i in which), key=lambda r: r.factors.get("load", 0.0)):
            chosen.setdefault(f"{record.quantity} least", record)
            chosen[f"{record.quantity} most"] = record
        # Runs of one condition show the same.
        few = {(r.quantity, r.condition, r.mounting): r for r in chosen.values()}
        return np.concatenate(self.threads.map(lambda record: self.glimpsed(record, high, low, first_order), few.values()))

    def glimpsed(self, record: Record, high: Asked, low: Asked, first_order: bool) -> Floats:
        """``glimpse`` of one record."""
        own, beside = self.own(record, high), self.own(record, low)
        places = glimpsed_angles(self.rough_bench, record) if record.quantity == "transmission_error" else None
        found = None
        if places is not None and self.bench.relevant(own, True) != self.bench.relevant(beside, True):
            try:
                found = glimpsed_error(self.rough_bench, record, own, beside, first_order)
            except RunFault:
                # Left to the whole prediction, which says so.
                found = None
        if found is None:
            found = self.predicted(record, high, low if first_order else None, True) - self.predicted(record, low, low if first_order else None, True)
            if places is not None:
                found = found[np.linspace(0, len(found) - 1, len(places)).astype(np.intp)]
        if record.free_zero:
            found = found - found.mean()
        allowed = self.rough_bench.allowed(record)
        return found * np.sqrt(len(record.values) / len(found)) / allowed if allowed > 0.0 else found

    def standing(self) -> dict[str, float]:
        """Nuisances where they start."""
        return {**self.zeros, **{p.name: p.off for p in self.declared}}

    def asked(self, values: Mapping[str, float]) -> Asked:
        """``values`` beside the nuisances where they start."""
        every = self.standing() | dict(values)
        effects = self.cages.effects(every)
        every |= self.lags.taken(effects)
        of_reducer = {name: value for name, value in every.items() if not (model_error.is_error(name) or is_from_there(name))}
        return Asked(every, of_reducer, self.chain.acting(every), effects)

    def shared(self, which: Sequence[int], asked: Asked, beside: Asked | None = None, rough: bool = False, changes: Changes = CHANGES) -> list[Floats]:
        """Predictions on all threads."""
        order = apart([self.records[i] for i in which])
        made = self.threads.map(lambda record: self.predicted(record, asked, beside, rough, changes), order)
        found = {id(record): prediction for record, prediction in zip(order, made)}
        return [found[id(self.records[i])] for i in which]

    def one(self, record: Record, values: Mapping[str, float], rough: bool = False) -> Floats:
        """Prediction of a record, which need not be one of the campaign's."""
        return self.predicted(record, self.asked(values), None, rough)

    def predicted(self, measured: Record, asked: Asked, beside: Asked | None, rough: bool, changes: Changes = CHANGES) -> Floats:
        """``one`` of values that are made ready; next to those ``beside`` by ``changes`` where there are such: to first order, or coarsely."""
        self.threads.check()
        curve = curve_of(measured)
        record = self.placed(curve, asked.effects, asked.values, not rough)
        try:
            predicted = self.observed(record, self.own(record, asked), None if beside is None else self.own(record, beside), rough, changes)
        except RunFault as fault:
            if not self.bench.relevant(asked.values, True):
                torque = impossible_torque(measured, self.campaign)
                if torque is None:
                    raise
                raise RunFault(f"{fault}. {torque.text}; {torque.remedy}") from None
            # Values at which the reducer finds no equilibrium fit badly; they end no search.
            return measured.values + far_off(len(measured.values), self.sizes.get(measured.quantity, 1.0))
        predicted = with_error(predicted, record, asked.values)
        if (error := asked.values.get(LOOPS, 0.0)) and is_loop(record):
            predicted = predicted + error * loop_error(self.bench, record)
        predicted = self.chained(predicted, record, asked)
        ripple = self.cages.ripple(record, asked.values)
        if ripple is not None:
            predicted = predicted + ripple
        if measured is not curve:
            return orders_shown(measured, predicted)
        if record.free_zero:
            # The mean of the prediction is that of the measurement.
            predicted = predicted - float(predicted.mean()) + float(bridged(record).values.mean())
        return predicted

    def chained(self, shown: Floats, record: Record, asked: Asked) -> Floats:
        """What the measuring chain makes of what the reducer shows, where effects act on it."""
        if not asked.acting:
            return shown
        return self.chain.changed(shown, record, asked.values, asked.acting, self.sizes.get(record.quantity) or size_of(shown))

    def observed(self, record: Record, own: Values, beside: Values | None, rough: bool, changes: Changes = CHANGES) -> Floats:
        """What the reducer shows, before the measuring chain: once for all runs that repeat each other."""
        changed = None if beside is None else changes.get(record.quantity)
        key = (self.identities.get(id(record)) or identity(record), rough, tuple(own.items()), changed and tuple((beside or {}).items()), changed)
        found = self.shown.get(key)
        if found is None:
            if len(self.shown) > MOST_SHOWN:
                self.shown.clear()
            bench = self.rough_bench if rough else self.bench
            change = changed(bench, record, own, beside) if changed and beside is not None else None
            if change is None or beside is None:
                found = np.asarray(OBSERVED[record.quantity](bench, record, own), float)
            else:
                # Beside a slope nobody asks how well the place of what is dear is known.
                found = self.observed(record, beside, None, rough or (changes is CHANGES and record.quantity in COARSE_CHANGES)) + change
            self.shown[key] = found
        return found

    def loop_at(self, values: Mapping[str, float], record: Record, place: float | None) -> Floats:
        """A loop [rad] roughly, with its input locked at ``place`` [rad], None: as the record has it, else as the mean over positions."""
        asked, record = self.asked(values), record if place is None else locked(record, place)
        try:
            found = OBSERVED[record.quantity](self.search_bench, record, self.own(record, asked))
        except RunFault:
            # Where the reducer finds no equilibrium it was not locked.
            return record.values + far_off(len(record.values), self.sizes.get(record.quantity, 1.0))
        return self.chained(found, record, asked)

    def error_with(self, values: Mapping[str, float], effects: Effects, record: Record, which: bool) -> Floats:
        """A transmission error [rad] roughly, with the ``effects`` of ``values`` or without; where there are none, with the model file's own or without."""
        without = {n: v for n, v in values.items() if n not in effects} if effects else {**values, **self.without_own}
        return self.one(record, values if which else without, True)

    def as_seen(self, record: Record, values: Mapping[str, float]) -> tuple[Record, dict[str, float]]:
        """``placed`` and ``for_record``."""
        asked = self.asked(values)
        return self.placed(record, asked.effects, asked.values), self.own(record, asked)

    def for_record(self, record: Record, values: Mapping[str, float]) -> dict[str, float]:
        """What a reducer knows of ``values``, with those of this record's mounting, condition or run under the plain name."""
        return self.own(record, self.asked(values))

    def own(self, record: Record, asked: Asked) -> dict[str, float]:
        """``for_record`` of values that are made ready."""
        places = {"mounting": record.mounting, "condition": record.condition, "run": record.name}
        own = {n: asked.values[f"{n}[{places[per]}]"] for n, per in self.per.items() if per in places and f"{n}[{places[per]}]" in asked.values}
        return asked.of_reducer | own if own else asked.of_reducer


def far_off(count: int, size: float) -> Floats:
    """What is added to so many measured values, of about this ``size``, where nothing can be predicted: with signs that no zero takes away."""
    return IMPOSSIBLE * size * np.where(np.arange(count) % 2 == 0, 1.0, -1.0)


def identities_of(records: Sequence[Record]) -> dict[int, tuple[Hashable, ...]]:
    """``identity`` by the address of each, while they live."""
    return {id(record): identity(record) for record in records}


def bench_of(model: ModelFile, settings: Mapping[str, float], fmus: Path | None) -> Bench:
    """The bench in this process, or that of the FMUs in a folder."""
    if fmus is None:
        return Bench(model.reducer, settings)
    # Here: what steps FMUs takes its time to load.
    from discrepancy.prediction.fmu_bench import FmuBench

    return FmuBench(model, settings, fmus)


def typical_size(records: list[Record]) -> float:
    """Size of a quantity: its mean, or its spread where the mean says nothing."""
    return size_of(np.concatenate([r.values[r.counted] for r in records]))


def size_of(values: Floats) -> float:
    return max(float(abs(np.mean(values))), float(np.std(values)), 1e-30)
