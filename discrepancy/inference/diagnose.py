"""The diagnosis: base fit, localisation, screening, refits, rivals, verdict."""

import dataclasses
import time
from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from typing import Any

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.held_out.consistency import lack_of_fit
from discrepancy.inference.held_out.held_out import WITHIN_NOISE, HeldOut, HeldOutJudge
from discrepancy.inference.misfit.features import ORDERS
from discrepancy.inference.misfit.localise import Localisation, Localiser
from discrepancy.inference.refit.confusable import FORM, confusable_set, ends_at_a_bound, has_idle_shapes, newest_at_a_bound, penalised, price
from discrepancy.inference.refit.curvature import covariance_by_secants
from discrepancy.inference.refit.effect_fit import renew
from discrepancy.inference.refit.refit import Refit, drop_cost, estimates, finished, leave_condition_out, refit
from discrepancy.inference.screening.screen import Score, Screen, bounded_gain, candidate_columns, joint_gain, screen
from discrepancy.inference.telling import Teller
from discrepancy.inference.verdict import INCOMPLETE, UNKNOWN, Diagnosis, Settings, decide
from discrepancy.problem import Candidate, Model

# Refits are dear: what a linear estimate leaves this far behind is not tried.
HOPELESS = 0.35
HOPELESS_EXCHANGE, HOPELESS_STAND_IN = 0.7, 0.5
# Of what a further effect must gain: play shows three tenths of it to first order, for it begins with a threshold.
FAR_SHORT = 0.2
# A one-sided effect whose score is below this chi-square may begin with no slope; so many of them are tried beside others.
SEEN_AT_ONCE, MOST_THRESHOLDS = 4.0, 3
# So many further effects are tried beside what is there already.
MOST_TRIALS = 7
# So many of the best fits are looked for from other starts too.
FOREMOST = 2
# What rough predictions may add to a chi-square, of what is gained.
ROUGH = 0.02
# An effect that is this many times as needed as it must be is kept without a refit of the others.
SURELY = 3.0


def few_of_each(scores: Sequence[Score]) -> list[Score]:
    """The two best variants of every effect (its name stands before the dot): near twins would crowd out other effects."""
    counts: dict[str, int] = {}
    kept = []
    for s in scores:
        effect = s.name.partition(".")[0]
        counts[effect] = counts.get(effect, 0) + 1
        if counts[effect] <= 2:
            kept.append(s)
    return kept


def foremost(trials: Sequence[Refit]) -> Refit:
    """The best of joint fits, those whose newest effect ends at a bound after all others."""
    return min([t for t in trials if not newest_at_a_bound(t)] or trials, key=penalised)


def against(judged: HeldOut | None) -> str:
    """What runs that were not fitted say against what is named; empty if nothing."""
    if judged is None:
        return ""
    if judged.after > max(judged.before, WITHIN_NOISE):
        return f"on runs that were not used the error grew from {judged.before:.2f} to {judged.after:.2f}: what is named fits, it does not explain"
    if judged.p_after < 0.0005 and judged.after > 1.5:
        return f"runs that were not used are not explained: their error is {judged.after:.2f} after {judged.before:.2f}, with 1 for noise alone"
    return ""


def widening(over: bool, inflation: float) -> float:
    """Of intervals, for a misfit that is ``over`` the noise by this factor in chi-square; twice at most."""
    return float(np.sqrt(min(inflation, 4.0))) if over else 1.0


def diagnose(model: Model, settings: Settings = Settings(), orders: Mapping[str, Sequence[float]] = ORDERS) -> Diagnosis:
    """Which effect of ``model.candidates`` the model lacks, if any, and how sure that is."""
    return Diagnostician(model, settings, orders).run()


class Diagnostician:
    """One diagnosis; the steps can be called one by one."""

    def __init__(self, model: Model, settings: Settings = Settings(), orders: Mapping[str, Sequence[float]] = ORDERS):
        self.model, self.settings, self.orders = model, settings, orders
        self.started = time.perf_counter()
        self.space = Workspace(model)
        self.candidates = list(model.candidates)
        self.by_name = {c.name: c for c in self.candidates}
        self.fitted: dict[frozenset[str], Refit] = {}
        self.final_fits: dict[frozenset[str], Refit] = {}
        self.widely: set[frozenset[str]] = set()
        self.inflations: dict[frozenset[str], float] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Without the large tables of its tests, which are made anew where they are asked for."""
        return {k: v for k, v in self.__dict__.items() if k not in ("localiser", "columns")}

    @cached_property
    def localiser(self) -> Localiser:
        return Localiser(self.space, self.orders)

    # steps --------------------------------------------------------------------------------
    def prepare(self) -> Localisation:
        """Base fit with the noise, and localisation of its misfit."""
        self.space.fit_base()
        self.localisation = self.localiser.test(self.space.base, self.settings.localise_level)
        return self.localisation

    def screened(self, candidates: Sequence[Candidate] | None = None) -> Screen:
        """Score tests of all candidates, or of some, against the base fit."""
        chosen = self.candidates if candidates is None else candidates
        with self.space.predictions.roughly():
            self.columns = candidate_columns(self.space, chosen, self.space.base.values)
        self.screening = screen(self.space, chosen, self.columns, self.space.base, self.settings.seed, self.settings.draws)
        self.scores = {s.name: s for s in self.screening.scores}
        return self.screening

    def fit(self, names: Sequence[str], start: dict[str, float] | None = None, scores: Sequence[Score] | None = None) -> Refit:
        """Joint refit of the named effects, remembered; by rough predictions until it is ``renewed``."""
        key = frozenset(names)
        if key not in self.fitted:
            found = list(scores or [self.scores[n] for n in names if n in self.scores])
            with self.space.predictions.roughly():
                self.fitted[key] = refit(self.space, [self.by_name[n] for n in names], found, start)
        return self.fitted[key]

    def beside(self, names: Sequence[str], own: dict[str, float], score: Score) -> Refit:
        """Joint refit of the named effects, which stand at ``own``, and the scored one."""
        return self.fit([*names, score.name], own, [score])

    def singles(self) -> list[Refit]:
        """Refits of the candidates that may win alone."""
        scores = [s for s in self.screening.scores if s.p_single < 0.05]
        if not scores:
            return []
        top = scores[0].statistic
        chosen = self.first_tried([s for s in scores if s.statistic >= 0.35 * top], top)
        for s in sorted(scores, key=lambda s: s.p_single)[:2]:
            if s not in chosen:
                chosen.append(s)
        fits = sorted(self.space.threads.map(lambda s: self.fit([s.name]), chosen), key=penalised)
        # Of the best effect all forms that show as much: five springs look alike in a loop.
        best = fits[0].candidates[0].name
        enough = (1.0 - ROUGH) * self.scores[best].statistic - 4 * self.settings.margin
        twins = [s for s in scores if s not in chosen and s.name.partition(".")[0] == best.partition(".")[0] and s.statistic >= enough]
        fits = sorted([*fits, *self.space.threads.map(lambda s: self.fit([s.name]), twins)], key=penalised)
        fits = sorted([*self.space.threads.map(self.widened, fits[:FOREMOST]), *fits[FOREMOST:]], key=penalised)
        near = fits[0].fit.chi2 + 4 * self.settings.margin + ROUGH * max(fits[0].gain, 0.0)
        fits = self.space.threads.map(lambda f: self.renewed(f) if f.fit.chi2 < near else f, fits)
        return sorted(fits, key=penalised)

    def first_tried(self, scores: list[Score], top: float) -> list[Score]:
        """Those that may win; where few numbers let many do as well to first order, all of these that can be, by their sizes."""
        near = 4 * self.settings.margin + ROUGH * top
        alike = [s for s in scores if s.statistic >= top - near]
        if len(few_of_each(alike)) <= self.settings.shortlist:
            return few_of_each(scores)[: self.settings.shortlist]
        promise = {s.name: self.promise(s) for s in alike}
        likely = [s for s in alike if promise[s.name] >= max(promise.values()) - near]
        return few_of_each(sorted(likely, key=lambda s: -promise[s.name]))

    def promise(self, score: Score) -> float:
        """What an effect could gain within its bounds if it were linear, less the price of its parameters and of an implausible size."""
        candidate = self.by_name[score.name]
        gain, sizes = bounded_gain(self.columns, self.space.base, score, candidate.amplitudes)
        return gain - price(candidate, sizes)

    def widened(self, result: Refit) -> Refit:
        """The fit from other starts too, if one of them is better: for those that may be named."""
        key, names = frozenset(c.name for c in result.candidates), [c.name for c in result.candidates]
        if key not in self.widely and key not in self.final_fits:
            self.widely.add(key)
            with self.space.predictions.roughly():
                other = refit(self.space, result.candidates, [self.scores[n] for n in names if n in self.scores], result.fit.values, widely=True)
            self.fitted[key] = min(result, other, key=lambda r: r.fit.chi2)
        return self.fitted[key]

    def final(self, names: Sequence[str]) -> Refit:
        """The fit of the named effects as it is reported, wherever."""
        return self.renewed(self.widened(self.fit(names)))

    def renewed(self, result: Refit) -> Refit:
        """The refit with predictions and sensitivities as they are reported, remembered in place of the first."""
        key = frozenset(c.name for c in result.candidates)
        if key in self.final_fits:
            return self.final_fits[key]
        self.space.predictions.settle(result.fit.values)
        better = finished(self.space, result.candidates, renew(self.space, result.fit, result.candidates))
        better = dataclasses.replace(better, covariance=covariance_by_secants(self.space, better.fit, result.candidates))
        self.fitted[key] = self.final_fits[key] = better
        return better

    def several(self, best: Refit) -> Refit:
        """Forward selection with a backward check; what counts is what a further effect gains of that which is left."""
        settings, current = self.settings, best
        while len(current.candidates) < settings.most_effects:
            names = [c.name for c in current.candidates]
            more = screen(self.space, self.candidates, self.columns, current.fit, settings.seed + len(names), settings.draws, exclude=names)
            promising = few_of_each([s for s in more.scores if s.p_adjusted < settings.second_level])[:MOST_TRIALS]
            least, lenient = self.least_gain(current, best)
            promising = [s for s in promising if s.statistic >= max(HOPELESS * promising[0].statistic, FAR_SHORT * least)]
            if lenient:
                promising += self.thresholds(more, [*names, *(s.name for s in promising)])
            if not promising:
                break
            own = {p.name: current.fit.values[p.name] for p in current.own}
            trials = self.space.threads.map(partial(self.beside, names, own), promising)
            # exchange of an earlier member: the first choice was made without the second
            challenger = foremost(trials)
            newest = challenger.candidates[-1].name
            if len(names) == 1:
                for other in few_of_each(self.screening.scores)[:5]:
                    if other.name in (names[0], newest) or frozenset([other.name, newest]) in self.fitted:
                        continue
                    if joint_gain(self.columns, self.space.base, other, self.scores[newest]) >= HOPELESS_EXCHANGE * challenger.gain:
                        trials.append(self.fit([other.name, newest]))
            challenger = self.renewed(foremost(trials))
            extra = current.fit.chi2 - challenger.fit.chi2
            if extra < least or extra < 12 + 2 * len(challenger.candidates[-1].parameters):
                break
            if lenient and not self.foretells(challenger, current):
                break
            current = self._backward(challenger, least)
            if len(current.candidates) <= len(names):
                break
        return current

    def thresholds(self, more: Screen, known: Sequence[str]) -> list[Score]:
        """Effects that begin with no slope (play): beside others a score test may not see them, so they are tried at their typical size."""
        found = []
        for s in more.scores:
            c = self.by_name[s.name]
            alone = len(c.amplitudes) == 1 and c.amplitudes[0].sign != 0 and not c.shapes
            if alone and s.name not in known and s.statistic < SEEN_AT_ONCE:
                p = c.amplitudes[0]
                found.append(dataclasses.replace(s, start={p.name: p.off + p.sign * p.scale}))
        return found[:MOST_THRESHOLDS]

    def least_gain(self, current: Refit, first: Refit) -> tuple[float, bool]:
        """What a further effect must gain, and whether that is less than a fixed part of the first: then it must be seen elsewhere too."""
        fixed = max(self.settings.second_gain * first.gain, 12.0)
        over, left, _, _ = self.leftover(current)
        if not over:
            return fixed, False
        needed = max(self.settings.needed * left, 12.0)
        return min(fixed, needed), needed < fixed

    def foretells(self, joint: Refit, current: Refit) -> bool:
        """Whether runs that were not fitted, or conditions left out in turn, are nearer to ``joint`` than to what there is already."""
        if self.space.held_out:
            judge = HeldOutJudge(self.space, self.localisation, [joint, current], self.orders)
            after, before = judge.judge(joint), judge.judge(current)
            if after is not None and before is not None:
                return after.after < before.after
        left = [sum(leave_condition_out(self.space, r.fit).values()) for r in (joint, current)]
        return left[0] < left[1]

    def _backward(self, joint: Refit, least: float) -> Refit:
        """Drops members without which the fit is hardly worse."""
        names = [c.name for c in joint.candidates]
        for name in names:
            rest = [n for n in names if n != name]
            if not rest:
                continue
            if drop_cost(joint, self.by_name[name]) > SURELY * least:
                continue
            without = self.renewed(self.fit(rest))
            if without.fit.chi2 - joint.fit.chi2 < least:
                return self._backward(without, least)
        return joint

    # judgement ----------------------------------------------------------------------------
    def leftover(self, result: Refit) -> tuple[bool, float, dict[str, Any], float]:
        """Whether ``result`` leaves a significant misfit, its size, what it is, and its inflation."""
        local = self.localiser.test(result.fit, self.settings.leftover_level)
        shape = lack_of_fit(self.space, result)
        worst: dict[str, float] = {}
        inflation = 1.0
        for g in local.findings:
            worst[g.signal] = max(worst.get(g.signal, 0.0), g.statistic - g.width)
            inflation = max(inflation, g.statistic / g.width)
        failing = {k: v for k, v in shape.items() if v[2] < self.settings.leftover_level}
        size = max(sum(worst.values()), max((s - w for s, w, _ in failing.values()), default=0.0))
        inflation = max([inflation, *(s / w for s, w, _ in failing.values())])
        text: dict[str, Any] = {"findings": [{"signal": g.signal, "feature": g.feature, "dependence": g.dependence, "p": g.p} for g in local.findings],
                "dependence": {k: {"statistic": s, "width": w, "p": p} for k, (s, w, p) in shape.items()}}
        return bool(worst or failing), size, text, inflation

    def run(self) -> Diagnosis:
        settings = self.settings
        local = self.prepare()
        self.screened()
        p_screen = min((s.p_adjusted for s in self.screening.scores), default=1.0)
        p_local = min((g.p for g in local.groups), default=1.0)
        by_place = bool(local.findings)
        # where the misfit is beyond doubt, naming needs less
        by_candidate = p_screen < (settings.naming_level if by_place else settings.screen_level)
        if not by_candidate:
            verdict, reason = decide(False, by_place, 0, 0, 0.0, True, settings)
            rivals = self.singles() if by_place else []
            return self.teller.diagnosis(verdict, reason, [], rivals, 0.0, {}, p_screen, p_local, {}, None)
        rivals = self.singles()
        final = self.several(rivals[0])
        over, size, text, inflation = self.leftover(final)
        captured = max(final.gain, 0.0) / max(max(final.gain, 0.0) + size, 1e-9)
        dof = self._dof(final)
        alternatives: dict[str, list[str]] = {}
        if len(final.candidates) == 1:
            members = confusable_set(rivals, inflation if over else 1.0, dof, settings.margin)
            if final not in members:
                members.insert(0, final)
            members += self._adequate(rivals, members)
        else:
            members = [final]
            for c in final.candidates:
                stand_ins = self._stand_ins(final, c, inflation if over else 1.0, dof)
                if stand_ins:
                    alternatives[c.name] = stand_ins
        self.report([*members, *rivals])
        judge = HeldOutJudge(self.space, local, [*members, *[r for r in rivals[:2] if r not in members]], self.orders)
        judged = judge.judge(final)
        unproved = against(judged)
        if unproved:
            over = True
            text["held_out"] = {"error": judged.after, "p": judged.p_after} if judged else {}
        self.inflations.update((frozenset(c.name for c in m.candidates), widening(over, inflation)) for m in members)
        one_sensor = all(c.part == "chain" for c in final.candidates) and len({c.signals for c in final.candidates}) == 1
        verdict, reason = decide(True, by_place, len(final.candidates), len(members) if not alternatives else 1, captured, over, settings, one_sensor, unproved)
        if verdict not in (UNKNOWN, INCOMPLETE) and alternatives:
            reason += "; some have alternatives that this campaign cannot separate"
        # Rivals are compared in common; what stands alone is judged as it will be when it is added to the model.
        shown = judge if len(members) > 1 else HeldOutJudge(self.space, local, members, self.orders)
        return self.teller.diagnosis(verdict, reason, members, rivals, captured, text, p_screen, p_local, alternatives, shown)

    def report(self, fits: Sequence[Refit]) -> None:
        """The predictions of what is told stay when the diagnosis is kept."""
        predictions = self.space.predictions
        predictions.report(self.space.base.values)
        for fit in fits:
            own = {p.name for p in fit.own}
            predictions.report(fit.fit.values)
            predictions.report({k: v for k, v in fit.fit.values.items() if k not in own})

    @property
    def teller(self) -> Teller:
        return Teller(self.space, self.localisation, self.scores, self.fitted, self.inflation, self.settings.coverage, self.started)

    def inflation(self, result: Refit) -> float:
        """By how much the intervals of ``result`` widen for a misfit that it leaves."""
        key = frozenset(c.name for c in result.candidates)
        if key not in self.inflations:
            over, _, _, inflation = self.leftover(result)
            self.inflations[key] = widening(over, inflation)
        return self.inflations[key]

    def _adequate(self, rivals: Sequence[Refit], members: Sequence[Refit]) -> list[Refit]:
        """Rivals a little behind that leave nothing unexplained: their law may only have a form slightly off."""
        least = penalised(members[0])
        margin = self.settings.adequate_margin + FORM * max(members[0].gain, 0.0)
        near = [r for r in rivals if r not in members and not ends_at_a_bound(r) and not has_idle_shapes(r) and penalised(r) - least <= margin]
        return [r for r in near if not self.leftover(r)[0]]

    def _dof(self, result: Refit) -> float:
        dofs = [e.dof for e in estimates(self.space, result)]
        return min(dofs) if dofs else 1e6

    def _stand_ins(self, final: Refit, member: Candidate, inflation: float, dof: float) -> list[str]:
        """Effects that could replace ``member`` beside the others."""
        rest = [c.name for c in final.candidates if c is not member]
        result = []
        rest_fit = self.fit(rest)
        more = screen(self.space, self.candidates, self.columns, rest_fit.fit, self.settings.seed, self.settings.draws, exclude=rest)
        own = {p.name: final.fit.values[p.name] for c in final.candidates if c is not member for p in c.parameters}
        needed = next((s.statistic for s in more.scores if s.name == member.name), 0.0)
        for s in few_of_each(more.scores)[:4]:
            if s.name == member.name or s.statistic < HOPELESS_STAND_IN * needed:
                continue
            rival = self.fit([*rest, s.name], own, [s])
            if len(confusable_set([final, rival], inflation, dof, self.settings.margin)) == 2:
                result.append(s.name)
        return result
