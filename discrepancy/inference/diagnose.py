"""The diagnosis: base fit, localisation, screening, refits, rivals, verdict."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from scipy.special import chdtrc, fdtrc

from discrepancy.inference.alone import WORTHWHILE, few_of_each
from discrepancy.inference.base_errors import computed_wrongly
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.chi_square import chi_text
from discrepancy.inference.judgement import Judgement, against, borne_out, widening
from discrepancy.inference.misfit.features import ORDERS
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.inference.outlook import NAMED, Outlook
from discrepancy.inference.refit.beside_base import Freed, base_parameters, freed
from discrepancy.inference.refit.confusable import confusable_set, number_first, penalised, unsettled
from discrepancy.inference.refit.refit import Refit, estimates
from discrepancy.inference.refit.refits import Refits
from discrepancy.inference.said import misfit_text
from discrepancy.inference.screening.screen import Score, Screen, candidate_columns, screen
from discrepancy.inference.screening.seen import only_seen
from discrepancy.inference.screening.visible import Visible, visible
from discrepancy.inference.selection import Selection
from discrepancy.inference.telling import SAME_CHI2, Teller
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, SET, STOPPED, UNKNOWN, Diagnosis, Interrupted, Settings, decide
from discrepancy.problem import BASE, CHAIN, Candidate, Model, PlacedAlone, effect_of
from fmu_src.percent import percent
from fmu_src.progress import say

# Level of what is gained in earnest: far from that of the screening, which is the test.
BY_CHANCE = 0.2
# Of a change of which calibrations leave less than this share, squared, to first order, a refit may show much more; so many effects are tried.
HIDDEN, MOST_HIDDEN = 0.1, 3
# So many of the effects that stand out most are said on the way.
FIRST = 3


def diagnose(model: Model, settings: Settings = Settings(), orders: Mapping[str, Sequence[float]] = ORDERS) -> Diagnosis:
    """Which effect of ``model.candidates`` the model lacks, if any, and how sure that is."""
    return Diagnostician(model, settings, orders).run()


class Diagnostician:
    """One diagnosis; the steps can be called one by one."""

    localisation: Localisation

    def __init__(self, model: Model, settings: Settings = Settings(), orders: Mapping[str, Sequence[float]] = ORDERS):
        self.model, self.settings, self.orders = model, settings, orders
        self.started = time.perf_counter()
        self.candidates = list(model.candidates)
        # Whether everything was begun anew, with records where they were taken.
        self.anew = False
        self.begin()

    def begin(self) -> None:
        self.space = Workspace(self.model)
        # Candidates as far as the campaign can see them.
        self.seen: dict[str, Candidate] = {}
        # Said if it is interrupted.
        self.doing = "fitting the base model"
        self.refits = Refits(self.space, self.candidates)
        self.judgement = Judgement(self.space, self.orders, self.settings.leftover_level)
        self.outlook = Outlook()

    def __getstate__(self) -> dict[str, Any]:
        """Without the large tables of its tests, which are made anew where they are asked for."""
        kept = {k: v for k, v in self.__dict__.items() if k != "columns"}
        # Of the clock what was spent: another process has another one, and hours between are no computing.
        return kept | {"started": self.started - time.perf_counter()}

    def __setstate__(self, kept: dict[str, Any]) -> None:
        self.__dict__.update(kept | {"started": time.perf_counter() + kept["started"]})

    # steps --------------------------------------------------------------------------------
    def prepare(self) -> Localisation:
        """Base fit with the noise, and localisation of its misfit; once."""
        if hasattr(self, "localisation"):
            return self.localisation
        self.space.fit_base()
        self.localisation = self.judgement.localisation = self.judgement.localiser.test(self.space.base, self.settings.localise_level)
        return self.localisation

    def screened(self, candidates: Sequence[Candidate] | None = None, beside: Refit | None = None) -> Screen:
        """Score tests of all candidates, or of some, against the base fit or ``beside`` a fit with effects."""
        self.chosen = self.candidates if candidates is None else list(candidates)
        fit, exclude = (self.space.base, []) if beside is None else (beside.fit, [c.name for c in beside.candidates])
        with self.space.predictions.roughly():
            columns = candidate_columns(self.space, self.chosen, fit.values)
        self.chosen, self.columns = only_seen(self.chosen, columns, self.seen)
        self.seen |= {c.name: c for c in self.chosen}
        self.refits.by_name |= self.seen
        self.screening = screen(self.space, self.chosen, self.columns, fit, self.settings.seed, self.settings.draws, exclude,
                                self.settings.sure_level)
        self.refits.scores = {**self.refits.scores, **{s.name: s for s in self.screening.scores}}
        return self.screening

    def visible(self) -> list[Visible]:
        """How large each effect that was looked for must be to be named without more ado; of the screening, so before anything is fitted beside it."""
        self.doing = "reckoning what would have been seen"
        with self.space.predictions.roughly():
            return visible(self.space, self.chosen, self.columns, {s.name: s.needed for s in self.screening.scores})

    @property
    def selection(self) -> Selection:
        return Selection(self.chosen, self.columns, self.screening, self.refits, self.judgement, self.settings, self.outlook)

    def calibrated(self, first: Sequence[str]) -> tuple[list[Refit], list[Refit]]:
        """Fits of the effects that key figures call for, before anything else is looked for: rivals alone, and the best together with what does as well."""
        if not (candidates := [c for c in self.candidates if effect_of(c.name) in first]):
            return [], []
        self.screened(candidates)
        return self.selection.calibrated(lambda fit: self.screened(beside=fit))

    def run(self, first: Sequence[str] = (), beyond: str = "") -> Diagnosis:
        """The whole diagnosis; ``first`` are calibrated before others are looked for, ``beyond``: what is off unless they explain it.

        Ctrl-C raises ``Interrupted`` with what is known by then; run again, it goes on with the fits and predictions that it has.
        """
        self.space.predictions.unfinished = True
        try:
            found = self.walk(first, beyond)
        except KeyboardInterrupt:
            if not hasattr(self, "localisation"):
                raise
            raise Interrupted(self.stopped()) from None
        self.space.predictions.unfinished = False
        return found

    def begins_anew(self, best: Refit) -> bool:
        """Whether the best effect, or one of the best, stands for a place of which nobody says it, and leaves something: from there all is looked for anew."""
        model = self.model
        if self.anew or not isinstance(model, PlacedAlone) or not self.judgement.leftover(best)[0]:
            return False
        own, values = {c.name: {p.name for p in c.parameters} for c in best.candidates}, best.fit.values
        if not any(model.place_alone(name, {n: v for n, v in values.items() if n not in own[name]}) for name in own):
            return False
        say(f"{best.name} leaves something, and at one place loops are as measured: all is looked for anew with inputs locked there")
        self.anew = True
        del self.localisation
        self.begin()
        self.space.predictions.unfinished = True
        return True

    def walk(self, first: Sequence[str], beyond: str = "") -> Diagnosis:
        """From the base fit to the verdict."""
        settings, local = self.settings, self.prepare()
        self.outlook.fitted(self.space.base)
        say(misfit_text(local))
        self.doing = "screening"
        rivals, calibrations = self.calibrated(first)
        start = next(iter(calibrations), None)
        p_first = min((s.p_adjusted for s in self.screening.scores), default=1.0) if start else 1.0
        p_local, by_place = min((g.p for g in local.groups), default=1.0), bool(local.findings)
        if beyond and (start is None or self.judgement.leftover(start)[0]):
            return self.nothing_named(by_place, rivals, p_first, p_local, beyond)
        self.screened(beside=start)
        p_screen = min([p_first, *(s.p_adjusted for s in self.screening.scores)])
        self.say_scores()
        self.outlook.screened()
        if settings.sure_level <= p_screen:
            p_screen = min(p_screen, self.p_refitted())
        # where the misfit is beyond doubt, or unused runs may confirm what is named, naming needs less
        by_candidate = p_screen < (settings.naming_level if by_place or self.space.held_out else settings.screen_level)
        selection, judgement = self.selection, self.judgement
        self.doing = "fitting effects alone"
        if start is None and (by_candidate or by_place):
            foremost = selection.foremost()
            if not (by_place or selection.may_stand(foremost, p_screen)):
                return self.nothing_named(by_place, [*foremost.first, *foremost.fits[1:]], p_screen, p_local)
            rivals = selection.compared(foremost)
        if not (by_candidate or (by_place and self.base_explains(rivals))):
            return self.nothing_named(by_place, rivals, p_screen, p_local)
        if start is None:
            start = number_first(rivals, settings.margin)[0]
            if self.begins_anew(start):
                return self.walk(first, beyond)
        say(f"best alone: {start.name}, {chi_text(start.gain)} of chi-square")
        self.doing = f"looking for what is missing beside {start.name}"
        final = selection.settled(selection.several(start, calibrations))
        if final is not start and self.begins_anew(final):
            return self.walk(first, beyond)
        if not self.beyond_chance(final):
            return self.nothing_named(by_place, rivals, p_screen, p_local)
        weighed = judgement.weighed(final, selection.fitted_in_earnest(final, rivals), settings.margin)
        fits_best, final = final, weighed.likeliest(final)
        refuted = final is not fits_best
        final = self.refits.reaching(final)
        self.doing = f"looking for what could stand in place of {final.name}"
        if len(final.candidates) == 1:
            self.outlook.after(NAMED)
        over, size, text, inflation = judgement.leftover(final)
        captured = max(final.gain, 0.0) / max(max(final.gain, 0.0) + size, 1e-9)
        dof = self.least_dof(final)
        alternatives: dict[str, list[Refit]] = {}
        open_ones: list[Refit] = []
        # What is left speaks for none of the rivals; it may have hidden no more than all of it.
        widened = min(inflation, 1.0 + size / settings.margin) if over else 1.0
        if len(final.candidates) == 1:
            # Found beside another, it may be a better fit than it was alone.
            rivals = [final, *(r for r in rivals if r.candidates != final.candidates)]
            # What unused runs refute stands beside it no more, however well it fits the others.
            left = [r for r in rivals if not weighed.refuted(r, final)]
            members = confusable_set(left, widened, dof, settings.margin)
            if final not in members:
                members.insert(0, final)
            members += selection.adequate(left, members)
            open_ones = unsettled(left, members, final, settings.margin)
            members = [m if m is final else self.refits.reaching(m) for m in [*members, *open_ones]]
        else:
            members = [final]
            for c in final.candidates:
                stand_ins = [r for r in selection.stand_ins(final, c, widened, dof) if not weighed.refuted(r, final)]
                if stand_ins:
                    alternatives[c.name] = stand_ins
        self.report([*members, *rivals])
        judge = judgement.held_out([*members, *[r for r in rivals[:2] if r not in members]])
        judged = judge.judge(final)
        if not by_place and not borne_out(p_screen, judged, settings.sure_level, settings.screen_level):
            return self.nothing_named(by_place, rivals, p_screen, p_local)
        unproved = against(judged)
        if unproved:
            over = True
            text["held_out"] = {"error": judged.after, "p": judged.p_after} if judged else {}
        judgement.inflations.update((m.key, widening(over, inflation)) for m in members)
        one_sensor = all(c.part == CHAIN for c in final.candidates) and len({c.signals for c in final.candidates}) == 1
        named = sum(c.part != BASE for c in final.candidates)
        verdict, reason = decide(True, by_place, named, len(members) if not alternatives else 1, captured, over, settings, one_sensor, unproved)
        if verdict == BASE_OFF:
            # What is named is shown in the model, not an effect that fits a little better in its place.
            members = [final, *(m for m in members if m is not final)]
            others = [m for m in members if m.candidates[0].part != BASE]
            alternatives |= {final.name: others} if others else {}
            if len(members) - len(others) > 1:
                reason += f"; which of {len(members) - len(others)} numbers it is this campaign cannot tell"
        if refuted:
            better = final.fit.chi2 - fits_best.fit.chi2
            how = f"better by {chi_text(better)} of chi-square" if better > SAME_CHI2 else "as well"
            reason += f"; {fits_best.name} fits {how}, but runs that were not used refute it"
        if verdict in (ONE, SET) and open_ones:
            reason += f"; with a value at a bound or one that this campaign says nothing about: {', '.join(r.name for r in open_ones)}"
        if verdict not in (UNKNOWN, INCOMPLETE) and alternatives:
            reason += "; some have alternatives that this campaign cannot separate"
        return self.teller.diagnosis(verdict, reason, members, rivals, captured, text, p_screen, p_local, alternatives, judgement.alone)

    def p_refitted(self) -> float:
        """p over all effects of the best refit of those that calibrations hide; 1 where none is worth one.

        An effect that halves the wear, and a wear coefficient that doubles it, leave each other little: a small difference of two changes
        that are far from linear, of which a score at the base fit sees a part.
        """
        hidden = sorted((s for s in self.screening.scores if s.left < HIDDEN and s.p_single < WORTHWHILE), key=lambda s: s.p_single)
        fits = self.selection.race("fitting what calibrations hide", few_of_each(hidden)[:MOST_HIDDEN])
        if not fits:
            return 1.0
        best = self.refits.renewed(min(fits, key=penalised))
        return min(1.0, float(fdtrc(len(best.own), self.least_dof(best), max(best.gain, 0.0) / len(best.own))) * len(self.screening.scores))

    def least_dof(self, result: Refit) -> float:
        """Degrees of freedom of the noise for the parameter of which it is known least."""
        return min((e.dof for e in estimates(self.space, result)), default=1e6)

    def beyond_chance(self, final: Refit) -> bool:
        """Whether a fit gains in earnest more than the best of all candidates may by chance: scores are made of rough predictions."""
        return float(chdtrc(len(final.own), max(final.gain, 0.0))) * len(self.refits.scores) < BY_CHANCE

    def base_explains(self, rivals: Sequence[Refit]) -> bool:
        """Whether a number of the base model takes a misfit away that is beyond doubt, though no effect, of so many, shows more than chance might."""
        if not rivals:
            return False
        best = number_first(rivals, self.settings.margin)[0]
        return best.candidates[0].part == BASE and self.beyond_chance(best) and not self.judgement.leftover(best)[0]

    def nothing_named(self, by_place: bool, rivals: list[Refit], p_screen: float, p_local: float, beyond: str = "") -> Diagnosis:
        """No candidate explains anything; ``by_place`` something is off all the same, ``beyond`` what of the base."""
        verdict, reason = (BASE_OFF, beyond) if beyond else decide(False, by_place, 0, 0, 0.0, True, self.settings)
        if verdict == NONE and computed_wrongly(self.space.base, self.settings.coverage):
            verdict, reason = BASE_OFF, "no effect is missing: what is off is what the base model computes, by more than was assumed of it"
        found = self.teller.diagnosis(verdict, reason, [], rivals, 0.0, {}, p_screen, p_local, {}, None)
        return replace(found, visible=self.visible()) if verdict == NONE else found

    def say_scores(self) -> None:
        """Which effects explain most before any is fitted: an order in which to look at them, and no answer."""
        first = sorted(self.screening.scores, key=lambda s: -s.statistic)[:FIRST]
        # Of what was tried at first, each has a score or shows nothing.
        idle = len(self.candidates) - len(self.refits.scores)
        without = f", the other {'one changes' if idle == 1 else f'{idle} change'} nothing here that could be seen" if idle else ""
        shown = ", ".join(f"{s.name} ({self.explained(s)})" for s in first)
        say(f"{self.tested}{without}; at first sight, each alone and none fitted yet, these could explain most: {shown}; no answer yet")

    def explained(self, score: Score) -> str:
        """What of the misfit (squares of residuals in units of their noise, beyond what noise makes) would go with an effect, were it linear and free."""
        beyond = self.space.base.chi2 - self.space.base.residual.size
        share = score.statistic / max(beyond, *(s.statistic for s in self.screening.scores))
        return f"{percent(share)} of the misfit{'' if score.p_adjusted < BY_CHANCE else ', which chance gives, too'}"

    @property
    def tested(self) -> str:
        return f"{len(self.refits.scores)} of {len(self.candidates)} effects tested"

    def stopped(self) -> Diagnosis:
        """What is known so far: base fit, localisation, scores, and the best fit."""
        fits = sorted(self.refits.fitted.values(), key=penalised)
        done = ["base fit"] + ([self.tested] if self.refits.scores else []) + ([f"{len(fits)} fits"] if fits else [])
        reason = f"stopped while {self.doing}; done: {', '.join(done)}"
        if fits:
            roughly = "" if fits[0].key in self.refits.final_fits else ", fitted roughly: its numbers may move by more than their intervals"
            reason += f"; best so far: {fits[0].name}{roughly}"
        captured = 0.0
        text: dict[str, Any] = {}
        if fits:
            _, size, text, _ = self.judgement.leftover(fits[0])
            captured = max(fits[0].gain, 0.0) / max(max(fits[0].gain, 0.0) + size, 1e-9)
        p_screen = min((s.p_adjusted for s in self.refits.scores.values()), default=1.0)
        p_local = min((g.p for g in self.localisation.groups), default=1.0)
        return self.teller.diagnosis(STOPPED, reason, fits[:1], fits, captured, text, p_screen, p_local, {}, None)

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
        return Teller(self.space, self.localisation, self.refits.scores, self.refits.fitted, self.judgement.inflation, self.beside_base,
                      self.settings.coverage, self.started)  # fmt: skip

    def beside_base(self, result: Refit) -> dict[str, Freed]:
        """What becomes of the parameters of ``result`` with the base model's numbers free within their ranges."""
        return freed(self.space, result, base_parameters(self.candidates, result.candidates))

    # for those who go on from here ----------------------------------------------------------
    def fit(self, names: Sequence[str]) -> Refit:
        """Joint refit of the named effects, remembered; see ``Refits``."""
        return self.refits.fit(names)

    def final(self, names: Sequence[str]) -> Refit:
        """The fit of the named effects as it is reported, wherever, with its intervals as they are told."""
        return self.refits.reaching(self.refits.final(names))

    def inflation(self, result: Refit) -> float:
        """By how much the intervals of ``result`` widen for a misfit that it leaves."""
        return self.judgement.inflation(result)
