"""The refits of one diagnosis, each made once: roughly while effects are looked for, in earnest for what is reported."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.bent import along_valley, explains_some
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.refit.effect_fit import EXPLAINS, LEAVES
from discrepancy.inference.refit.in_earnest import followed, in_earnest
from discrepancy.inference.refit.joint import from_there, jointly, left_by, left_of, there
from discrepancy.inference.refit.reach import BETTER, reach
from discrepancy.inference.refit.refit import Refit, finished, refit
from discrepancy.inference.screening.screen import Score
from discrepancy.problem import Candidate, Places, Placing

# Chi-squares of two starts that show the same, one over the other less 1.
ALIKE = 1e-6
# Chi-square by which another zero of angles is surely the right one.
SURELY = 25.0
# Chi-square that an effect gains, from which it may tell zeros of angles apart that look alike without it (assumed).
TELLS_ZEROS = 100.0
# Of what effects gain, what a fit in earnest gains more than a rough one which had begun elsewhere, and what tells zeros of angles no more.
OF_GAIN = 0.1
# Chi-square by sample of a fit that may leave something.
LEFT = 1.0
# So often a walk along a valley begins anew, each time where it is better.
MOST_WALKS = 5
# Of places that look alike so many are tried in earnest; a fit that is better at one of them tells more of the next, and goes on so often.
MOST_OTHERS, MOST_MOVES = 2, 6
# What is placed beside an effect may move with its fit, and the fit with that: so often it follows.
AGAIN = 3


def in_order(found: Refit, candidates: Sequence[Candidate]) -> Refit:
    """The refit with its effects as they are asked for: who asks takes the last for the one that came in place of another."""
    return found if found.candidates == tuple(candidates) else replace(found, candidates=tuple(candidates))


def beside(values: Mapping[str, float], counted: Sequence[str]) -> list[dict[str, float]]:
    """The parts before and behind those that ``values`` count."""
    return [{name: float(whole(values[name])) for name in counted} for whole in (math.floor, math.ceil) if counted]


class Refits:
    """``fitted`` by the names of the effects, ``final_fits`` of them those that are reported; ``scores`` say where a fit starts."""

    def __init__(self, space: Workspace, candidates: Sequence[Candidate]):
        self.space = space
        self.by_name = {c.name: c for c in candidates}
        self.scores: Mapping[str, Score] = {}
        self.fitted: dict[frozenset[str], Refit] = {}
        self.final_fits: dict[frozenset[str], Refit] = {}
        # What a fit's chi-square fell by when it was made in earnest.
        self.gained: dict[frozenset[str], float] = {}
        # Of that, what it fell by where it went to another zero of angles that looked alike without it.
        self.gained_there: dict[frozenset[str], float] = {}
        self.widely: set[frozenset[str]] = set()
        # Where effects stood when the cages were placed with them; whether there were any to be placed.
        self.settled: dict[frozenset[str], dict[str, float]] = {}
        self.places: dict[frozenset[str], bool] = {}

    def fit(self, names: Sequence[str], start: dict[str, float] | None = None, scores: Sequence[Score] | None = None,
            least: float = np.inf) -> Refit:  # fmt: skip
        """Joint refit of the named effects, remembered; by rough predictions until it is ``renewed``.

        What will not come below the chi-square ``least`` is left where that became clear.
        """
        key = frozenset(names)
        if key not in self.fitted:
            found = list(scores or [self.scores[n] for n in names if n in self.scores])
            with self.space.predictions.roughly():
                self.fitted[key] = refit(self.space, [self.by_name[n] for n in names], found, start, least=least)
        return in_order(self.fitted[key], [self.by_name[n] for n in names])

    def placed(self, name: str) -> Refit:
        """The refit of an effect that shows only where each record is placed with it: from that of its forms and places of the angles' zeros which
        leaves least of the record with the largest misfit."""
        model, space, candidate = self.space.model, self.space, self.by_name[name]
        if not isinstance(model, Placing):
            return self.fit([name])
        base, parameters = space.base, (*space.model.nuisances, *candidate.parameters)
        typical = {p.name: p.off + (p.sign or 1) * p.scale for p in candidate.amplitudes}
        directions = [p.name for p in candidate.shapes if p.is_direction]
        forms = [{**base.values, **typical, **{p.name: p.off for p in candidate.shapes}, **shape} for shape in candidate.shape_grid or ({},)]
        starts = [{**form, **place} for form in forms for place in ({}, *model.waves_on(form, directions)[0])]
        one = space.furthest_off(candidate)
        alone = space.only([one])

        def left(start: dict[str, float]) -> float:
            space.predictions.settle(start, [one])
            return float(np.sum(alone.residual(start) ** 2))

        found = [left(start) for start in starts]
        start = starts[int(np.argmin(found))]
        space.predictions.settle(start)
        with space.predictions.roughly():
            self.fitted[frozenset([name])] = finished(space, [candidate], jointly(space, parameters, start, (name,)))
        return self.fitted[frozenset([name])]

    def widened(self, result: Refit, least: float = np.inf) -> Refit:
        """The fit from other starts too, if one of them is better: for those that may be named."""
        key, names = result.key, [c.name for c in result.candidates]
        if key not in self.widely and key not in self.final_fits:
            self.widely.add(key)
            with self.space.predictions.roughly():
                other = refit(self.space, result.candidates, [self.scores[n] for n in names if n in self.scores], result.fit.values, True, least)
            self.fitted[key] = min(result, other, key=lambda r: r.fit.chi2)
        return in_order(self.fitted[key], result.candidates)

    def is_wide(self, result: Refit) -> bool:
        """Whether other starts were tried."""
        return result.key in self.widely

    def forget(self, result: Refit) -> None:
        """A fit that nobody goes on with says nothing of its effect."""
        self.fitted.pop(result.key, None)

    def along_valley(self, name: str, rate: float) -> Refit:
        """The fit of an effect alone from places all along the valley of its two amplitudes, if one of them is better; ``rate``: see ``bent.exchange``."""
        known = self.fit([name])
        if explains_some(self.space, known.fit):
            with self.space.predictions.roughly():
                # Fitted in earnest it would be compared with rough ones.
                here = there(self.space, known.fit)
                fit = along_valley(self.space, here, known.candidates[0], rate)
                if fit.chi2 < here.chi2 - BETTER:
                    self.final_fits.pop(frozenset([name]), None)
                    self.fitted[frozenset([name])] = finished(self.space, known.candidates, fit)
        return self.fitted[frozenset([name])]

    def reaching(self, result: Refit) -> Refit:
        """A fit that is named, with the ends of its intervals where the valley of two amplitudes ends; from a better place, where one lies on the way."""
        if result.stretch:
            return result
        key = result.key
        found = reach(self.space, result)
        for _ in range(MOST_WALKS):
            if found.better is None:
                break
            values = {**result.fit.values, **found.better}
            self.final_fits.pop(key, None)
            other = self.renewed(finished(self.space, result.candidates, there(self.space, replace(result.fit, values=values))))
            if other.fit.chi2 > result.fit.chi2 - BETTER:
                break
            result = other
            found = reach(self.space, result)
        self.fitted[key] = self.final_fits[key] = replace(result, stretch=found.stretch)
        return in_order(self.fitted[key], result.candidates)

    def without(self, joint: Refit, name: str) -> Refit:
        """The fit of the others of ``joint`` as it is reported, from its own start and from where they stand in ``joint``."""
        rest = [c for c in joint.candidates if c.name != name]
        key, known = frozenset(c.name for c in rest), self.fit([c.name for c in rest])
        with self.space.predictions.roughly():
            other = refit(self.space, rest, [], {p.name: joint.fit.values[p.name] for c in rest for p in c.parameters})
        if other.fit.chi2 < known.fit.chi2 - BETTER:
            self.fitted[key] = other
            self.final_fits.pop(key, None)
        alone = self.renewed(self.fitted[key])
        return alone if alone.fit.chi2 < joint.fit.chi2 + BETTER else self.placed_as(alone, joint)

    def placed_as(self, alone: Refit, joint: Refit) -> Refit:
        """The fit of some effects of ``joint`` with all that is placed beside effects where it stands beside all of these, if it is better there: a further
        effect may have gained by other places alone."""
        model, predictions, key = self.space.model, self.space.predictions, alone.key
        if not isinstance(model, Placing) or not model.unplaced():
            return alone
        before, there = (model.places(predictions.active(r.fit.values)) for r in (alone, joint))
        start = {name: joint.fit.values[name] for name in alone.fit.values}
        predictions.put(start, there)
        other = finished(self.space, alone.candidates, *in_earnest(self.space, replace(alone.fit, values=start), alone.candidates))
        if other.fit.chi2 > alone.fit.chi2 - BETTER:
            predictions.put(start, before)
            return alone
        self.fitted[key] = self.final_fits[key] = other
        return other

    def final(self, names: Sequence[str]) -> Refit:
        """The fit of the named effects as it is reported, wherever."""
        return self.renewed(self.widened(self.fit(names)))

    def renewed(self, result: Refit, least: float = np.inf) -> Refit:
        """The refit with predictions and sensitivities as they are reported, remembered in place of the first; ``least``: see ``in_earnest``."""
        key = result.key
        if key in self.final_fits:
            return in_order(self.final_fits[key], result.candidates)
        roughly = result.fit.chi2
        better, model, predictions = self.from_its_zero(key, result, least), self.space.model, self.space.predictions
        if isinstance(model, Placing) and roughly - better.fit.chi2 > OF_GAIN * better.gain:
            # Far from where it ends it told little of the zeros.
            places = model.places(predictions.active(better.fit.values))
            again = self.from_its_zero(key, better, least)
            if again.fit.chi2 < better.fit.chi2 - BETTER:
                better = again
            else:
                predictions.put(better.fit.values, places)
        for _ in range(MOST_MOVES):
            before, better = better, self.otherwise(better, least)
            if better is before:
                break
        self.gained[key] = max(roughly - better.fit.chi2, 0.0)
        self.fitted[key] = self.final_fits[key] = better
        return better

    def from_its_zero(self, key: frozenset[str], result: Refit, least: float) -> Refit:
        """The refit in earnest, from the zeros of angles that its effects tell, with all that is placed beside them following it."""
        self.settled.pop(key, None)
        result = self.at_its_zero(result)
        if key not in self.settled:
            self.settle(key, result)
        better = finished(self.space, result.candidates, *in_earnest(self.space, result.fit, result.candidates, least))
        for _ in range(AGAIN):
            if not (self.space.predictions.unsettled(better.fit.values) or self.has_moved(key, better)):
                break
            self.settle(key, better)
            better = finished(self.space, result.candidates, *followed(self.space, better.fit, result.candidates, better.covariance, least))
        return better

    def at_its_zero(self, result: Refit) -> Refit:
        """The refit where it would begin with zeros of angles that looked alike without its effects, if these are large and it is surely better there."""
        model, predictions = self.space.model, self.space.predictions
        if not isinstance(model, Placing):
            return result
        directions = [p.name for c in result.candidates for p in c.shapes if p.is_direction]
        unseen = bool(model.unseen(result.fit.values))
        if not unseen and result.fit.chi2 > EXPLAINS * self.space.base.chi2 and result.gain < TELLS_ZEROS:
            return result
        places, some = model.waves_on(result.fit.values, directions)
        if not unseen and self.zeros_are_told(result, places):
            return result
        few = self.space.only(some)
        # A wrong zero has bent the effects: each is tried with those that suit it, and with the parts that these stand between.
        counted = [p.name for c in result.candidates for p in c.shapes if p.counts]
        places = [{**place, **parts} for place in ({}, *places) for parts in ({}, *beside(result.fit.values, counted))]
        # Turned with the discs an effect may show as it does unturned: from there the same fit would be made again.
        left = [left_by(few, replace(result.fit, values={**result.fit.values, **place})) for place in places]
        places = [place for k, place in enumerate(places) if not any(np.isclose(left[k], other, ALIKE) for other in left[:k])]
        begun = [replace(result.fit, values=from_there(few, result.fit, {**result.fit.values, **place})) for place in places]
        if unseen:
            # What transmission errors show alike half a turn on is told by loops as soon as these have a place, each with its own.
            turned = [{p.name: other for p, other in half_a_turn_on(result.candidates, fit.values)} for fit in begun]
            begun += [replace(fit, values={**fit.values, **others}) for fit, others in zip(begun, turned) if others]
        before, left, by_errors, found, placed = model.places(predictions.active(result.fit.values)), [], [], [], False
        for fit in begun:
            predictions.put(fit.values, before)
            placed = predictions.settle(fit.values, self.space.training) or placed
            left.append(left_by(self.space, fit))
            by_errors.append(left[-1] if unseen else left_by(few, fit))
            found.append(model.places(predictions.active(fit.values)))
        best, stood = int(np.argmin(left)), [fit.values for fit in begun]
        if (other := int(np.argmin(by_errors))) != best:
            # Loops hold what a lag leaves open, but a wrong zero has bent what they alone tell, too: a fit of all says which is right.
            for k in (best, other):
                predictions.put(begun[k].values, found[k])
                begun[k] = replace(result.fit, values=from_there(self.space, result.fit, begun[k].values))
                left[k] = left_by(self.space, begun[k])
                found[k] = model.places(predictions.active(begun[k].values))
            best = int(np.argmin(left))
        chosen = 0 if left[best] > left[0] - SURELY else best
        predictions.put(begun[chosen].values, found[chosen])
        if len(self.space.training) == len(self.space.records):  # else what goes with runs that are held out is left to be placed
            self.settled[result.key], self.places[result.key] = stood[chosen], placed
        self.gained_there[result.key] = max(left[0] - left[chosen], self.gained_there.get(result.key, 0.0))
        return result if chosen == 0 else replace(result, fit=begun[chosen])

    def zeros_are_told(self, result: Refit, places: Sequence[Mapping[str, float]]) -> bool:
        """Whether the zeros, which might be at other ``places`` that look alike, are those of a fit in earnest of some of the effects that leaves little, to
        which the others add little."""
        smaller = [r for key, r in self.final_fits.items() if key < result.key]
        known = max(smaller, key=lambda r: r.gain, default=None)
        if known is None or result.gain - known.gain > OF_GAIN * result.gain or known.fit.chi2 > LEAVES * len(known.fit.residual):
            return False
        if any(p.counts or p.is_direction for c in result.candidates if c.name not in known.key for p in c.shapes):
            return False
        values, before = result.fit.values, known.fit.values
        there = [(values[name] - before[name], values[name] - at) for place in places for name, at in place.items() if name in values]
        return all(abs(off) < 0.5 * abs(to_other) for off, to_other in there)

    def otherwise(self, result: Refit, least: float) -> Refit:
        """The refit with what the model has placed at another place that looks alike, the first that is better, if something may be left of the misfit."""
        model, fit = self.space.model, result.fit
        if not isinstance(model, Placing) or fit.chi2 < LEFT * len(fit.residual):
            return result
        predictions = self.space.predictions
        active = predictions.active(fit.values)
        before = model.places(active)

        def others() -> Iterator[tuple[dict[str, float], Places]]:
            yield from (({}, places) for places in self.promising(fit, model.elsewhere(active)))
            predictions.put(fit.values, before)
            if half := model.otherwise(active):
                yield half, before

        for values, places in others():
            start = replace(fit, values={**fit.values, **values})
            predictions.put(start.values, places)
            other = finished(self.space, result.candidates, *in_earnest(self.space, start, result.candidates, least))
            if other.fit.chi2 < fit.chi2 - BETTER:
                return other
        predictions.put(fit.values, before)
        return result

    def promising(self, fit: Fit, others: Sequence[Places]) -> list[Places]:
        """Those places at which a fit would be better after one linear step of all that is fitted, the most promising first: what looks nearly alike is
        bent alike."""

        def promised(places: Places) -> float:
            self.space.predictions.put(fit.values, places)
            return left_of(self.space.residual(fit.values), fit.jacobian)

        found = sorted((promised(places), k) for k, places in enumerate(others))
        return [others[k] for chi2, k in found[:MOST_OTHERS] if chi2 < fit.chi2 - BETTER]

    def seen(self, result: Refit) -> Refit:
        """The refit where it stands, with predictions as they are reported: what tells whether it is worth a fit in earnest."""
        key = result.key
        if key in self.final_fits:
            return in_order(self.final_fits[key], result.candidates)
        self.settle(key, result)
        with self.space.predictions.anchored(result.fit.values):
            self.fitted[key] = finished(self.space, result.candidates, there(self.space, result.fit))
        return self.fitted[key]

    def settle(self, key: frozenset[str], result: Refit) -> None:
        """What is placed beside an effect (the roller cages) placed with this one, once."""
        if self.settled.get(key) != result.fit.values:
            self.places[key], self.settled[key] = self.space.predictions.settle(result.fit.values), result.fit.values

    def is_placed(self, result: Refit) -> bool:
        """Whether there was something to be placed beside a fit in earnest."""
        return self.places.get(result.key, False)

    def has_moved(self, key: frozenset[str], result: Refit) -> bool:
        """Whether a fit has gone further from where the cages were placed than it is known: they hold it back, and it holds them."""
        before, fit = self.settled[key], result.fit
        far = np.abs([fit.values[p.name] - before[p.name] for p in fit.parameters])
        return self.places[key] and bool(np.any(far > np.sqrt(np.diag(result.covariance))))

    def gained_in_earnest(self, result: Refit) -> float:
        """By how much rough predictions have made a fit look worse than it is; others may look as much too bad."""
        return self.gained.get(result.key, 0.0)

    def gained_elsewhere(self, result: Refit) -> float:
        """By how much a fit is better at zeros of angles to which it went in earnest; where these are, others may gain as much."""
        return self.gained_there.get(result.key, 0.0)
