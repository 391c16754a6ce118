"""Which effects are fitted alone: what may win, and from where it is looked for."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TypeVar

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.judgement import Judgement, borne_out
from discrepancy.inference.outlook import IN_EARNEST, Outlook
from discrepancy.inference.refit.bent import exchange, leaves_some
from discrepancy.inference.refit.confusable import FORM, penalised, price
from discrepancy.inference.refit.joint import may_reach
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.refit.refits import Refits
from discrepancy.inference.screening.screen import Columns, Score, Screen, bounded_gain
from discrepancy.inference.verdict import Settings
from discrepancy.problem import BASE, Candidate, effect_of

# What has a name and leads to a refit.
Named = TypeVar("Named", Score, Refit)

# Level of one effect alone from which a refit is worthwhile.
WORTHWHILE = 0.05
# So many of the best fits are looked for from other starts too.
FOREMOST = 2
# What rough predictions may add to a chi-square, of what is gained (a tenth of the change, that squared; a thousandth is usual), and what a
# linear estimate may.
ROUGH, LINEAR, USUALLY_ROUGH = 0.01, 0.02, 0.001
# Of what the best effect explains, what others explain that are looked at beside it where it leaves something.
NEARLY = 0.9
# Chi-square by which a fit is so far behind one that leaves no more than noise that none of another start stands beside that, nor with the roller cages
# placed beside it (assumed).
FAR = 100.0
# Chi-square by sample of a calibration that leaves so much that what is next is told without its fit in earnest (assumed).
VERY_MUCH = 100.0


def few_of_each(scores: Sequence[Score]) -> list[Score]:
    """The two best variants of every effect (its name stands before the dot): near twins would crowd out other effects.

    Numbers of the base model are no variants of each other.
    """
    counts: dict[str, int] = {}
    kept = []
    for s in scores:
        effect = s.name if s.name.startswith(BASE) else effect_of(s.name)
        counts[effect] = counts.get(effect, 0) + 1
        if counts[effect] <= 2:
            kept.append(s)
    return kept


def more_of(form: Refit, best: Refit) -> bool:
    """Whether one is a form of the other's effect that can do more."""
    (a,), (b,) = form.candidates, best.candidates
    return effect_of(a.name) == effect_of(b.name) and len(a.parameters) > len(b.parameters)


def explains_nearly(fit: Refit, best: Refit) -> bool:
    """Whether a fit explains nine tenths of what the best does."""
    return fit.gain > NEARLY * best.gain


def close_behind(fits: Sequence[Refit], near: float, leaves: bool) -> tuple[list[Refit], list[Refit]]:
    """Of the rough ``fits`` behind the best those that may be as good, and the others; if the best ``leaves`` something the foremost that explain nearly as
    much are among them wherever they stand: where an output goes through its play rough predictions err by more than ``near`` allows for."""
    chosen = {id(f) for k, f in enumerate(fits[1:]) if f.fit.chi2 < near or (leaves and k < FOREMOST and explains_nearly(f, fits[0]))}
    return [f for f in fits[1:] if id(f) in chosen], [f for f in fits[1:] if id(f) not in chosen]


@dataclass(frozen=True)
class Foremost:
    """Rough fits of single effects, the best first, and this in earnest (``first``, alone in its list; none of a calibration on the way to others); whether
    it ``leaves`` something; ``rates`` of the effects two amplitudes of which do nearly the same (see ``bent.exchange``)."""

    fits: list[Refit] = field(default_factory=list)
    first: list[Refit] = field(default_factory=list)
    leaves: bool = False
    rates: Mapping[str, float] = field(default_factory=dict)


class Alone:
    """Chooses among ``candidates`` by their scores of ``screening``, fits them with ``refits`` and judges what they leave."""

    # Whether what key figures call for is calibrated, before anything else is looked for.
    calibrating = False

    def __init__(self, candidates: Sequence[Candidate], columns: Columns, screening: Screen, refits: Refits, judgement: Judgement, settings: Settings,
                 outlook: Outlook):  # fmt: skip
        self.candidates, self.columns, self.screening = candidates, columns, screening
        self.refits, self.judgement, self.settings, self.outlook = refits, judgement, settings, outlook
        self.scores = {s.name: s for s in screening.scores}
        self.space: Workspace = refits.space

    def singles(self) -> list[Refit]:
        """Refits of the candidates that may win alone."""
        return self.compared(self.foremost())

    def foremost(self) -> Foremost:
        """The candidates that may win alone, fitted roughly, and the best of them in earnest."""
        scores = [s for s in self.screening.scores if s.p_single < WORTHWHILE]
        if not scores:
            return Foremost()
        top = scores[0].statistic
        chosen = self.first_tried([s for s in scores if s.statistic >= 0.35 * top], top)
        for s in sorted(scores, key=lambda s: s.p_single)[:2]:
            if s not in chosen:
                chosen.append(s)
        fits = sorted(self.race("fitting alone", chosen), key=penalised)
        # Of the best effect all forms that show as much: five springs look alike in a loop.
        best = fits[0].candidates[0].name
        enough = (1.0 - LINEAR) * self.scores[best].statistic - 4 * self.settings.margin
        twins = [s for s in scores if s not in chosen and effect_of(s.name) == effect_of(best) and s.statistic >= enough]
        fits = sorted([*fits, *self.tried("fitting alone, forms that look alike", lambda s: self.refits.fit([s.name]), twins)], key=penalised)
        rates = {c.name: rate for k, c in enumerate(self.candidates) if c.name in self.scores and (rate := exchange(self.columns, k, c)) is not None}
        # Of a large effect much is left until it is fitted in earnest.
        if fits[0].candidates[0].name in rates and leaves_some(fits[0].fit):
            fits = self.along_valleys(fits, rates)
        fits = self.widely(fits, fits[:1], self.near(fits[0]))
        if self.is_on_the_way(fits[0]):
            return Foremost(fits)
        self.outlook.after(IN_EARNEST)
        first = self.tried("fitting in earnest", self.refits.renewed, fits[:1])
        return Foremost(fits, first, self.judgement.leftover(first[0])[0], rates)

    def may_stand(self, found: Foremost, p: float) -> bool:
        """Whether the best effect, or one that may be as good, can be named where the best score has this ``p``: unused runs that are to confirm it and do not
        are known before the others are fitted in earnest."""
        if not found.first or found.leaves or p < self.settings.sure_level:
            return True
        fits = [*found.first, *close_behind(found.fits, self.near(found.fits[0]), False)[0]]
        judge = self.judgement.held_out(fits)
        return any(borne_out(p, judge.judge(f), self.settings.sure_level, self.settings.screen_level) for f in fits)

    def compared(self, found: Foremost) -> list[Refit]:
        """The fits of single effects, those in earnest that may be as good as the best."""
        fits, first, leaves, rates = found.fits, found.first, found.leaves, found.rates
        if not first:
            return fits
        if leaves:
            # What is dear to look for.
            more = self.tried("fitting alone, each run placed", lambda s: self.refits.placed(s.name), self.shown())
            rest = sorted([*more, *fits[1:]], key=penalised)
            rest = rest if fits[0].candidates[0].name in rates else self.along_valleys(rest, rates)
            fits = [fits[0], *self.widely(rest, [*rest[:1], *self.rivals(rest)], self.near((rest or fits)[0]))]
        else:
            fits = [fits[0], *self.widely(fits[1:], [f for f in self.rivals(fits) if self.is_close(f, fits[0])], self.near(fits[0]))]
        near = self.near(fits[0])
        if self.refits.is_placed(first[0]):
            # What is placed beside an effect is placed beside the base model until it is seen.
            near = max(near, fits[0].fit.chi2 + FAR)
        near += self.refits.gained_in_earnest(first[0])
        looked_at, behind = close_behind(fits, near, leaves)
        others = self.tried("fitting in earnest", partial(self.as_reported, first[0], None), looked_at)
        unfinished = [f for f in behind if more_of(f, first[0]) and not self.refits.is_wide(f)]
        for fit in unfinished:
            self.refits.forget(fit)
        return sorted([*first, *others, *(f for f in behind if f not in unfinished)], key=penalised)

    def is_on_the_way(self, fit: Refit) -> bool:
        """Whether a calibration leaves so much beside which another way to fit it is little: others follow it, before that is worth what it takes."""
        return self.calibrating and fit.fit.chi2 > VERY_MUCH * len(fit.fit.residual)

    def widely(self, fits: Sequence[Refit], chosen: Sequence[Refit], least: float = np.inf) -> list[Refit]:
        """``fits``, the ``chosen`` ones from other starts too, where they may come below the chi-square ``least``; the best first."""
        if not chosen:
            return list(fits)
        found = self.tried("fitting from other starts", partial(self.refits.widened, least=least), chosen)
        return sorted([*found, *(f for f in fits if f not in chosen)], key=penalised)

    def rivals(self, fits: Sequence[Refit]) -> list[Refit]:
        """The foremost of ``fits`` behind the best; not those that leave as little as one that leaves no more than noise: a better one would only follow the
        noise.  Forms of the best effect that can do more than it are of use only where it leaves something."""
        if not fits:
            return []
        enough = -np.inf if leaves_some(fits[0].fit) else fits[0].fit.chi2 + self.settings.margin
        return [f for f in fits[1:FOREMOST] if f.fit.chi2 > enough and not more_of(f, fits[0])]

    def is_close(self, rival: Refit, best: Refit) -> bool:
        """Whether another start may bring a rival beside one that leaves no more than noise: not if it is far behind."""
        return rival.fit.chi2 - best.fit.chi2 < max(FAR, USUALLY_ROUGH * best.gain)

    def along_valleys(self, fits: list[Refit], rates: Mapping[str, float]) -> list[Refit]:
        """``fits``, those of effects two amplitudes of which do nearly the same (``rates``: see ``bent.exchange``) from wherever their valley goes on."""
        found = self.tried("fitting along valleys", lambda s: self.refits.along_valley(s.name, rates[s.name]), [self.scores[name] for name in rates])
        return sorted([*found, *(f for f in fits if f.candidates[0].name not in rates)], key=penalised)

    def shown(self) -> list[Score]:
        """Candidates that are known by orders alone, where the misfit has these."""
        orders = {finding.feature.removeprefix("orders: ") for finding in self.judgement.localisation.findings}
        return [s for s in self.screening.scores if orders & set(self.refits.by_name[s.name].families)]

    def first_tried(self, scores: list[Score], top: float) -> list[Score]:
        """Those that may win; where few numbers let many do as well to first order, all of these that can be, by their sizes."""
        near = 4 * self.settings.margin + LINEAR * top
        alike = [s for s in scores if s.statistic >= top - near]
        if len(few_of_each(alike)) <= self.settings.shortlist:
            return few_of_each(scores)[: self.settings.shortlist]
        promise = {s.name: self.promise(s) for s in alike}
        likely = [s for s in alike if promise[s.name] >= max(promise.values()) - near]
        return few_of_each(sorted(likely, key=lambda s: -promise[s.name]))

    def promise(self, score: Score) -> float:
        """What an effect could gain within its bounds if it were linear, less the price of its parameters and of an implausible size."""
        candidate = self.refits.by_name[score.name]
        gain, sizes = bounded_gain(self.columns, self.space.base, score, candidate.amplitudes)
        return gain - price(candidate, sizes)

    def race(self, what: str, scores: Sequence[Score], beside: Refit | None = None) -> list[Refit]:
        """Refits of each of ``scores``, ``beside`` the effects of a fit from where these stand; the first two say what the others must reach: what rough
        predictions err in those effects they do alike in all."""
        names, own = ([c.name for c in beside.candidates], beside.at) if beside else ([], None)
        before = beside.fit if beside else self.space.base

        def one(least: float, score: Score) -> Refit:
            return self.refits.fit([*names, score.name], own, [score], least)

        ahead = self.tried(what, partial(one, np.inf), scores[:2])
        if len(scores) < 3:
            return ahead
        best = min(ahead, key=penalised)
        least = self.near(best, before.chi2 - best.fit.chi2) + penalised(best) - best.fit.chi2
        return [*ahead, *self.tried(f"{what}, those further behind", partial(one, least), scores[2:])]

    def near(self, best: Refit, gained: float | None = None) -> float:
        """Chi-square below which a rough fit may be as good as ``best``, which ``gained`` so much beside what both have."""
        return best.fit.chi2 + 4 * self.settings.margin + ROUGH * max(best.gain if gained is None else gained, 0.0)

    def as_good(self, best: Refit, gained: float | None = None) -> float:
        """Chi-square below which a fit in earnest may stand beside ``best`` as an answer, or in place of an effect in it that ``gained`` so much."""
        return best.fit.chi2 + max(4 * self.settings.margin, self.little_behind(best.gain if gained is None else gained))

    def little_behind(self, gain: float) -> float:
        """Chi-square by which a fit may be worse than one that gains so much where its law may only have a form slightly off."""
        return self.settings.adequate_margin + FORM * max(gain, 0.0)

    def as_reported(self, best: Refit, gained: float | None, rival: Refit) -> Refit:
        """A rival as it is reported, fitted in earnest if it may come ``as_good`` as ``best`` from where predictions in earnest leave it: at other zeros of
        angles, to which that one went, it may gain as much."""
        seen = self.refits.seen(rival)
        least = self.as_good(best, gained) + self.refits.gained_elsewhere(best)
        return self.refits.renewed(seen, least) if may_reach(seen.fit, least) else seen

    def tried(self, what: str, function: Callable[[Named], Refit], items: Sequence[Named]) -> list[Refit]:
        """``function`` of every score or refit, told as it goes."""
        return self.space.threads.told(what, function, items, lambda item: item.name)
