"""Which effects are fitted together: further ones beside what is there already, and what each could be replaced by."""

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import combinations, product

import numpy as np

from discrepancy.inference.alone import FAR, FOREMOST, ROUGH, Alone, explains_nearly, few_of_each
from discrepancy.inference.judgement import Judgement
from discrepancy.inference.outlook import Outlook
from discrepancy.inference.refit.confusable import (
    confusable_set,
    ends_at_a_bound,
    has_idle_shapes,
    is_settled,
    newest_at_a_bound,
    newest_does_nothing,
    number_first,
    penalised,
    unsettled,
)
from discrepancy.inference.refit.effect_fit import EXPLAINS
from discrepancy.inference.refit.refit import Refit, drop_cost, reshaped
from discrepancy.inference.refit.refits import OF_GAIN, Refits
from discrepancy.inference.screening.screen import Columns, Score, Screen, joint_gain, screen
from discrepancy.inference.verdict import Settings
from discrepancy.problem import BASE, Candidate, Placing, effect_of

# Refits are dear: what a linear estimate leaves this far behind is not tried.
HOPELESS = 0.35
HOPELESS_EXCHANGE, HOPELESS_STAND_IN = 0.7, 0.5
# Of what a further effect must gain: play shows three tenths of it to first order, for it begins with a threshold; and what rough predictions show of it
# where it is worth a fit in earnest.
FAR_SHORT = 0.2
# So many one-sided effects that are not promising are tried beside others: they may begin with no slope.
MOST_THRESHOLDS = 3
# So many further effects are tried beside what is there already.
MOST_TRIALS = 7
# Chi-square by sample of joint fits that leave much: rough predictions leave a third of it beside what noise does.
MUCH = 1.5
# So many of the best joint fits are computed in earnest, if one turns out to be none.
MOST_IN_EARNEST = 3
# Where pairs leave much, so many other effects are begun with, which alone explain nearly as much as the best does.
MOST_FIRSTS = 3
# An effect that is this many times as needed as it must be is kept without a refit of the others.
SURELY = 3.0
# Of several effects so many members give way to others in their place, one after another.
MOST_EXCHANGES = 3


def ranked(trials: Sequence[Refit], margin: float, before: float) -> list[Refit]:
    """Joint fits, the best first (see ``number_first``), those whose newest effect ends at a bound after others that are not plainly worse; ``before``: the
    chi-square without it."""

    def standing(trial: Refit) -> float:
        return penalised(trial) + (max(FAR, OF_GAIN * (before - trial.fit.chi2)) if newest_at_a_bound(trial) else 0.0)

    return number_first(sorted(trials, key=standing), margin)


def fits_alone(refits: Refits) -> list[Refit]:
    """Fits of single effects, the best first."""
    return sorted((r for names, r in refits.fitted.items() if len(names) == 1), key=penalised)


def leaves_much(trials: Sequence[Refit]) -> bool:
    """Whether all of these fits leave much of their misfit."""
    return all(r.fit.chi2 > MUCH * len(r.fit.residual) for r in trials)


class Selection(Alone):
    """Chooses what is added to what is there, and what could stand in the place of each."""

    def __init__(self, candidates: Sequence[Candidate], columns: Columns, screening: Screen, refits: Refits, judgement: Judgement, settings: Settings,
                 outlook: Outlook):  # fmt: skip
        super().__init__(candidates, columns, screening, refits, judgement, settings, outlook)
        # What was fitted in place of a member, by the fit and the member's name.
        self.in_place: dict[tuple[frozenset[str], str], list[Refit]] = {}

    # several ------------------------------------------------------------------------------
    def several(self, best: Refit, calibrations: Sequence[Refit] = ()) -> Refit:
        """Forward selection with a backward check; what counts is what a further effect gains of that which is left.

        ``calibrations``: ``best`` and what calibrates as well, the effects of which do not count towards the most that are looked for.
        """
        settings, current = self.settings, best
        calibrated = frozenset().union(*(fit.key for fit in calibrations))
        while len(current.key - calibrated) < settings.most_effects:
            names = [c.name for c in current.candidates]
            more = screen(self.space, self.candidates, self.columns, current.fit, settings.seed + len(names), settings.draws, exclude=names)
            promising = few_of_each([s for s in more.scores if s.p_adjusted < settings.second_level])[:MOST_TRIALS]
            least, plainly = self.least_gain(current, best)
            promising = [s for s in promising if s.statistic >= max(HOPELESS * promising[0].statistic, FAR_SHORT * least)]
            if least < plainly:
                promising += self.thresholds(more, [*names, *(s.name for s in promising)])
            if not promising:
                break
            self.outlook.found(len(current.key - calibrated))
            trials = self.race(f"fitting beside {' + '.join(names)}", promising, current)
            # exchange of an earlier member: the first choice was made without the second
            challenger = ranked(trials, settings.margin, current.fit.chi2)[0]
            newest = challenger.candidates[-1].name
            if len(names) == 1:
                close = self.close_alone(names[0]) if current.fit.chi2 - challenger.fit.chi2 >= FAR_SHORT * least else []
                trials += self.exchanged(names[0], newest, challenger.gain, close)
                if not calibrations and self.all_placed(current):
                    trials = self.widely_beside(trials, current.fit.chi2)
                    if leaves_much(trials):
                        trials += self.widely_beside(self.begun_otherwise(current), current.fit.chi2)
            if current is best:
                trials += [self.refits.fit([*(c.name for c in other.candidates), newest], other.at) for other in calibrations[1:]]
                if calibrations and leaves_much(trials):
                    first = min(trials, key=penalised)
                    trials = [self.reshaped(first), *(r for r in trials if r is not first), *self.of_other_forms(trials, best)]
            if current.fit.chi2 - min(r.fit.chi2 for r in trials) + FAR + self.refits.gained_in_earnest(current) < FAR_SHORT * least:
                break
            challenger = self.in_earnest(trials, current.fit.chi2)
            extra = current.fit.chi2 - challenger.fit.chi2
            if extra < least or extra < 12 + 2 * len(challenger.candidates[-1].parameters) or newest_does_nothing(challenger):
                break
            if extra < plainly and not (self.judgement.is_whole(challenger) or self.judgement.foretells(challenger, current)):
                break
            current = self.backward(challenger, least)
            if len(current.candidates) <= len(names):
                break
        # Calibrations on the way to others are fitted roughly.
        return current if self.calibrating else self.refits.renewed(current)

    def calibrated(self, screened: Callable[[Refit], Screen]) -> tuple[list[Refit], list[Refit]]:
        """Rivals alone, and ``calibrations``; where these leave so much that an effect hides what calibrates, the one beside which one more may leave least
        comes first (``screened``: all effects beside a fit)."""
        self.calibrating = True
        rivals = self.singles()
        found = self.calibrations(rivals[0]) if rivals else []
        if len(found) > 1 and self.is_on_the_way(found[0]):
            found.sort(key=lambda fit: fit.fit.chi2 - max(s.statistic for s in screened(fit).scores))
        return rivals, found

    def begun_without(self, best: Refit) -> list[Refit]:
        """The best fit of two calibrations, neither of which is what ``best`` begins with in any of its forms; springs that look alike alone do not beside
        friction."""
        forms: dict[str, list[Score]] = {}
        for s in self.screening.scores:
            if effect_of(s.name) != effect_of(best.candidates[0].name):
                forms.setdefault(effect_of(s.name), []).append(s)
        if len(forms) < 2:
            return []

        def best_of(pairs: Iterable[tuple[Score, Score]]) -> Refit:
            return min((self.refits.fit([a.name, b.name], self.where_alone(a.name)) for a, b in pairs), key=penalised)

        one, other = (forms[effect_of(c.name)] for c in best_of(combinations([first for first, *_ in forms.values()], 2)).candidates)
        return [best_of(product(one, other))]

    def calibrations(self, first: Refit) -> list[Refit]:
        """What calibrates best, beginning with ``first``, and the fit of other effects that comes as near as laws do whose form is slightly off, if it differs
        by more than one: a seat with memory does what a spring and friction do.  Which it is the next effect tells; one in place of one is tried at the end."""
        best = self.several(first)
        if self.is_on_the_way(best):
            return [self.refits.seen(r) for r in [best, *self.begun_without(best)]]
        others = [r for r in self.refits.fitted.values() if not r.key > best.key and len(r.key ^ best.key) > 2 and r.fit.chi2 < self.as_good(best)]
        return [best, *sorted(others, key=penalised)[:1]]

    def in_earnest(self, trials: Sequence[Refit], before: float) -> Refit:
        """The best of joint fits as it is reported; what the model cannot compute but roughly gives way to the next, and what is less ahead of the next
        than predictions in earnest move it is compared with that in earnest.  ``before``: see ``ranked``."""
        order = ranked(trials, self.settings.margin, before)
        if self.is_on_the_way(order[0]):
            return order[0]
        found: list[Refit] = []
        moved, holds = 0.0, False
        for trial in order[:MOST_IN_EARNEST]:
            if holds and penalised(trial) - penalised(order[0]) > moved:
                break
            least = min((self.as_good(r, before - r.fit.chi2) for r in found), default=np.inf)
            found += self.tried("fitting in earnest", partial(self.refits.renewed, least=least), [trial])
            moved = max(moved, abs(trial.fit.chi2 - found[-1].fit.chi2))
            holds = holds or found[-1].fit.chi2 <= self.near(trial)
        return ranked(found, self.settings.margin, before)[0]

    def exchanged(self, first: str, newest: str, gain: float, close: Sequence[Score] = ()) -> list[Refit]:
        """Fits of the newest effect beside others than the first that may gain as much together: what explains most, and what was ``close`` to the first."""
        others = few_of_each(self.screening.scores)[:5]
        others += [s for s in close if s not in others]
        return [
            self.refits.fit([other.name, newest], self.where_alone(other.name)) for other in others
            if other.name not in (first, newest) and frozenset([other.name, newest]) not in self.refits.fitted
            and joint_gain(self.columns, self.space.base, other, self.scores[newest]) >= HOPELESS_EXCHANGE * gain
        ]  # fmt: skip

    def reshaped(self, first: Refit) -> Refit:
        """A joint fit beside calibrations, or a better one from other shapes of its effects, remembered in its place."""
        if first.key not in self.refits.final_fits:
            with self.space.predictions.roughly():
                self.refits.fitted[first.key] = first = reshaped(self.space, first)
        return first

    def of_other_forms(self, trials: Sequence[Refit], calibration: Refit) -> list[Refit]:
        """Joint fits of the two foremost newest effects of ``trials`` beside a ``calibration`` that begins with another form: which of the springs that look
        alike yields, the newest hid before it was there."""
        first, *others = (c.name for c in calibration.candidates)
        alike = [r for r in fits_alone(self.refits) if effect_of(r.name) == effect_of(first) and r.name != first]
        newest = list(dict.fromkeys(trial.candidates[-1].name for trial in sorted(trials, key=penalised)))[:FOREMOST]
        pairs = [self.refits.fit([form.name, *others], {**calibration.at, **form.at}) for form in alike]
        apart = [(name, pair) for name, pair in product(newest, pairs) if name not in pair.key]
        return [self.refits.fit([*(c.name for c in pair.candidates), name], pair.at, [self.scores[name]]) for name, pair in apart]

    def all_placed(self, fit: Refit) -> bool:
        """Whether it is known of all records where they were taken; else that may be what a fit leaves."""
        model = self.space.model
        return not isinstance(model, Placing) or not model.unseen(fit.fit.values)

    def begun_otherwise(self, first: Refit) -> list[Refit]:
        """Pairs of effects that begin with others which explain nearly as much alone: of two large ones the best alone may be neither."""
        base, pairs = [c.name for c in self.candidates if c.part == BASE], []
        others = [r for r in fits_alone(self.refits) if r.name not in (first.name, *base) and explains_nearly(r, first)]
        for other in others[:MOST_FIRSTS]:
            more = screen(self.space, self.candidates, self.columns, other.fit, self.settings.seed, self.settings.draws, exclude=[other.name, *base])
            promising = [s for s in few_of_each(more.scores) if frozenset([other.name, s.name]) not in self.refits.fitted]
            promising = [s for s in promising if s.statistic >= HOPELESS * more.scores[0].statistic][:MOST_TRIALS]
            pairs += self.race(f"fitting beside {other.name}", promising, other)
        return pairs

    def widely_beside(self, trials: Sequence[Refit], before: float) -> list[Refit]:
        """Joint fits, the best from other starts too if all leave much: where cages and zeros of angles were placed beside others these hold them."""
        if not (trials and leaves_much(trials)):
            return list(trials)
        foremost = sorted(trials, key=penalised)[:MOST_TRIALS]
        if self.is_on_the_way(foremost[0]):
            return list(trials)
        most = before - min(r.fit.chi2 for r in foremost)
        return self.widely(trials, [r for r in foremost if before - r.fit.chi2 > EXPLAINS * most])

    def close_alone(self, first: str) -> list[Score]:
        """Effects whose fits alone come as near to that of the first as laws do whose form is slightly off: which of them it is, the next effect may tell."""
        near = self.as_good(self.refits.fitted[frozenset([first])])
        return [self.scores[r.name] for r in fits_alone(self.refits) if r.fit.chi2 < near and r.name in self.scores]

    def where_alone(self, name: str) -> dict[str, float] | None:
        """Where an effect was fitted alone: a score beside one that does the same says nothing of its size."""
        alone = self.refits.fitted.get(frozenset([name]))
        return alone.at if alone else None

    def thresholds(self, more: Screen, known: Sequence[str]) -> list[Score]:
        """Effects that begin with no slope (play): beside others a score test sees little of them, so some are tried at their typical size."""
        found = []
        for s in more.scores:
            c = self.refits.by_name[s.name]
            alone = len(c.amplitudes) == 1 and c.amplitudes[0].sign != 0 and not c.shapes
            if alone and s.name not in known:
                p = c.amplitudes[0]
                found.append(dataclasses.replace(s, start={p.name: p.off + p.sign * p.scale}))
        return found[:MOST_THRESHOLDS]

    def least_gain(self, current: Refit, first: Refit) -> tuple[float, float]:
        """What a further effect must gain if it is seen elsewhere too, and from where on it need not: a fixed part of the first."""
        fixed = max(self.settings.second_gain * first.gain, 12.0)
        over, left, _, _ = self.judgement.leftover(current)
        return min(fixed, max(self.settings.needed * left, 12.0)) if over else fixed, fixed

    def backward(self, joint: Refit, least: float) -> Refit:
        """Drops members without which the fit is hardly worse."""
        names = [c.name for c in joint.candidates]
        for name in names:
            rest = [n for n in names if n != name]
            if not rest:
                continue
            if drop_cost(joint, self.refits.by_name[name]) > SURELY * least:
                continue
            without = self.refits.without(joint, name)
            if without.fit.chi2 - joint.fit.chi2 < least:
                return self.backward(without, least)
        return joint

    # in place of --------------------------------------------------------------------------
    def adequate(self, rivals: Sequence[Refit], members: Sequence[Refit]) -> list[Refit]:
        """Rivals a little behind that leave nothing unexplained: their law may only have a form slightly off."""
        least = penalised(members[0])
        margin = self.little_behind(members[0].gain)
        near = [r for r in rivals if r not in members and not ends_at_a_bound(r) and not has_idle_shapes(r) and penalised(r) - least <= margin]
        return [r for r in near if not self.judgement.leftover(r)[0]]

    def stand_ins(self, final: Refit, member: Candidate, inflation: float, dof: float) -> list[Refit]:
        """Fits with effects that could replace ``member`` beside the others, each as the last."""

        def exchanged(joint: Refit) -> Sequence[Candidate]:
            return (member,) if joint is final else joint.candidates[-1:]

        rivals = sorted(self.in_place_of(final, member), key=penalised)
        plain = [r for r in rivals if len(confusable_set([final, r], inflation, dof, self.settings.margin, exchanged)) == 2]
        return sorted([*plain, *unsettled(rivals, plain, final, self.settings.margin, exchanged)], key=penalised)

    def settled(self, final: Refit) -> Refit:
        """A fit in which no member gives way to another in its place: a joint one, or one alone that stands for a simpler effect."""
        if len(final.candidates) == 1 and not is_settled(final):
            alone = [r for r in fits_alone(self.refits) if r.key in self.refits.final_fits]
            return next((r for r in alone if self.gives_way(final, final.candidates[0], r)), final)
        for _ in range(MOST_EXCHANGES if len(final.candidates) > 1 else 0):
            better = [r for c in final.candidates for r in self.in_place_of(final, c) if self.gives_way(final, c, r)]
            if not better:
                break
            final = min(better, key=penalised)
        return final

    def fitted_in_earnest(self, final: Refit, rivals: Sequence[Refit]) -> list[Refit]:
        """Effects whose fits, alone or in a member's place, came near enough to ``final`` to be made in earnest; ``rivals`` are the fits alone."""
        others = rivals if len(final.candidates) == 1 else [r for c in final.candidates for r in self.in_place_of(final, c)]
        effects = [r for r in others if r.name != final.name and all(c.part != BASE for c in r.candidates)]
        return [r for r in effects if r.key in self.refits.final_fits]

    def gives_way(self, final: Refit, member: Candidate, rival: Refit) -> bool:
        """Whether ``rival``, with another effect in place of ``member``, is plainly better; or as good, where the member ends at a bound or has a shape of
        which nothing is known, so that it stands for a simpler one."""
        worse, simple, plain = penalised(rival) - penalised(final), is_settled(final, [member]), is_settled(rival, rival.candidates[-1:])
        if plain and not simple:
            return worse <= self.settings.margin
        return plain == simple and worse < -self.settings.margin

    def in_place_of(self, final: Refit, member: Candidate) -> list[Refit]:
        """Joint fits with other effects in place of ``member``; those that are near are fitted in earnest like ``final``."""
        key = final.key, member.name
        if key not in self.in_place:
            self.in_place[key] = self.replacements(final, member)
        return self.in_place[key]

    def replacements(self, final: Refit, member: Candidate) -> list[Refit]:
        rest = [c.name for c in final.candidates if c is not member]
        rest_fit = self.refits.fit(rest)
        more = screen(self.space, self.candidates, self.columns, rest_fit.fit, self.settings.seed, self.settings.draws, exclude=rest)
        own = {p.name: final.fit.values[p.name] for c in final.candidates if c is not member for p in c.parameters}
        needed = next((s.statistic for s in more.scores if s.name == member.name), 0.0)
        others = [s for s in more.scores if s.name != member.name and s.statistic >= HOPELESS_STAND_IN * needed]
        chosen = [s for s in few_of_each(more.scores)[:4] if s in others]
        # By a curvature that a kink may have made.
        gained = min(drop_cost(final, member), max(final.gain, 0.0))
        near = final.fit.chi2 + 4 * self.settings.margin + ROUGH * gained + self.refits.gained_in_earnest(final)
        what = f"fitting in place of {member.name}"
        rivals = self.tried(what, lambda s: self.refits.fit([*rest, s.name], own, [s], near), chosen)
        # Of what comes near all forms that show as much: four springs look alike in a loop.
        alike = {effect_of(c.name) for c in (member, *(r.candidates[-1] for r in rivals if r.fit.chi2 < near)) if c.part != BASE}
        twins = [s for s in others if s not in chosen and effect_of(s.name) in alike]
        rivals += self.tried(f"{what}, forms that look alike", lambda s: self.refits.fit([*rest, s.name], own, [s], near), twins)
        # What is roughly near is looked at in earnest; only what may stand there is fitted so.
        reported = self.tried(f"{what}, in earnest", partial(self.as_reported, final, gained), [r for r in rivals if r.fit.chi2 < near])
        return [*reported, *(r for r in rivals if r.fit.chi2 >= near)]
