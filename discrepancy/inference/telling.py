"""What a diagnosis tells: effects with estimates and errors, what was turned down and why, warnings."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from discrepancy.inference.base_errors import UNLIKELY, base_errors
from discrepancy.inference.base_fit.projection import project_out
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.chance import chance
from discrepancy.inference.chi_square import chi_text
from discrepancy.inference.held_out.held_out import HeldOut
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.beside_base import WIDER, Freed, widened
from discrepancy.inference.refit.confusable import canonical_correlation, penalised
from discrepancy.inference.refit.reach import carried
from discrepancy.inference.refit.refit import Estimate, Refit, drop_cost, estimates, leave_condition_out
from discrepancy.inference.screening.screen import Score
from discrepancy.inference.verdict import BASE_OFF, STOPPED, Diagnosis, Effect, Fits, StandIn
from discrepancy.problem import BASE, Candidate, Parameter

# Chi-square by which two fits are not told to differ.
SAME_CHI2 = 0.05
# What shows less of an effect than this share of what was measured says nothing of its size.
SHOWN = 0.05


def beyond(space: Workspace, member: Refit, candidate: Candidate) -> bool:
    """Whether an effect changes every signal that shows it by more than the whole of what was measured: another makes up for it."""
    own = {p.name for p in candidate.parameters}
    which = [i for i in space.touched(candidate) if i in space.rows]
    values = member.fit.values
    changes = [a - b for a, b in zip(space.predictions(values, which), space.predictions({k: v for k, v in values.items() if k not in own}, which))]
    ratios = []
    for stream in {stream_of(space.records[i]) for i in which}:
        members = [(space.records[i], change) for i, change in zip(which, changes) if stream_of(space.records[i]) == stream]
        measured = np.concatenate([np.zeros(0 if any(r.free_zero for r, _ in members) else 1), *(r.values[np.isfinite(r.values)] for r, _ in members)])
        change = np.concatenate([np.zeros(len(measured) - sum(np.isfinite(r.values).sum() for r, _ in members)), *(c for _, c in members)])
        ratios.append(float(np.ptp(change)) / max(float(np.ptp(measured)), 1e-300))
    shown = [ratio for ratio in ratios if ratio > SHOWN]
    return bool(shown) and min(shown) > 1.0


def grown(name: str, before: float, after: float) -> list[str]:
    """A warning of an effect beside which runs that were not fitted are further off; none where the digits that are told everywhere stay the same."""
    was, now = f"{before:.2f}", f"{after:.2f}"
    return [f"{name}: the misfit in the patterns of runs not used for fitting grew from {was} to {now}"] if after > before and now != was else []


@dataclass(frozen=True)
class Teller:
    """What there is to tell from: ``inflation`` widens the intervals of a fit, ``beside_base`` says what would become of each of its
    parameters with the base model's numbers free, ``started`` is when the diagnosis began [s]."""

    space: Workspace
    localisation: Localisation
    scores: Mapping[str, Score]
    fitted: Mapping[frozenset[str], Refit]
    inflation: Callable[[Refit], float]
    beside_base: Callable[[Refit], Mapping[str, Freed]]
    coverage: float
    started: float

    def diagnosis(
        self, verdict: str, reason: str, members: Sequence[Refit], rivals: Sequence[Refit], captured: float, leftover: dict[str, Any],
        p_screen: float, p_local: float, alternatives: Mapping[str, Sequence[Refit]], judge: Callable[[Refit], HeldOut | None] | None,
    ) -> Diagnosis:  # fmt: skip
        """Everything that is told, in plain data."""
        effects = []
        held_out: dict[str, dict[str, Any]] = {}
        several = bool(members) and len(members[0].candidates) > 1
        warnings = list(self.space.noise.warnings)
        for member in members:
            before, after = self._errors(judge, member, captured, held_out)
            numbers = {e.name: e for e in estimates(self.space, member, self.coverage, self.inflation(member))}
            # Who interrupts waits for nothing more.
            freed = {} if verdict == STOPPED else self.beside_base(member)
            for c in (c for c in member.candidates if c.part != BASE):
                gain = self._gain_of(member, c) if several else member.gain
                # What the data say nothing about is anywhere in its range, and stands where it stood.
                bounds = tuple(p.name for p in c.parameters if numbers[p.name].at_bound)
                if bounds:
                    warnings.append(f"{c.name}: {', '.join(bounds)} ended at a bound of its range; the law or the range may be wrong")
                share = min(1.0, gain / max(member.gain, 1e-300)) * captured if several else \
                    captured * member.gain / max(members[0].gain, 1e-300)
                warnings += told_together(c, numbers) + told_over(c, member)
                outside = verdict != STOPPED and beyond(self.space, member, c)
                if outside:
                    warnings.append(f"{c.name}: alone it changes more than all that was measured, so that its parameters are bounds and no values")
                told_of = {p.name: numbers[p.name].to_dict() | {"bound": outside, "meaning": meaning(p)} | with_base(numbers[p.name], p, freed)
                           for p in by_weight(self.space, member, c)}
                effects.append(Effect(c.name, c.title, c.part, told_of,
                                      float(min(share, 1.0)), float(gain), before, after, bounds,
                                      self.scores[c.name].p_adjusted if c.name in self.scores else 1.0, *beside_first(member, members)))
                warnings += grown(c.name, before, after)
        if several:
            effects.sort(key=lambda e: -e.gain)
        # A number of the base that is named is no rival either.
        names = {e.name for e in effects} | {c.name for m in members for c in m.candidates if c.part == BASE}
        stand_ins = {name: [self.stand_in(r, members[0]) for r in others] for name, others in alternatives.items()}
        standing = {c.name for others in alternatives.values() for r in others for c in r.candidates[-1:]} if several else set()
        rejected: list[dict[str, Any]] = []
        least = min((r.fit.chi2 for r in rivals), default=0.0)
        for r in rivals:
            if r.name not in names | standing:
                worse = r.fit.chi2 - (members[0].fit.chi2 if members else least)
                why = why_not(r, members[0], worse, "all that is named" if several else "") if members else "not significant after correction for multiplicity"
                why = f"alone {why}" if several else why
                rejected.append({"name": r.name, "chi2_difference": float(worse), "reason": why})
        for s in self.scores.values():
            if s.name not in names | standing and not any(x["name"] == s.name for x in rejected):
                rejected.append({"name": s.name, "chi2_difference": None, "reason": f"score test: {chance(s.p_adjusted)} over all effects, "
                                 f"explains {chi_text(s.statistic)} of chi-square alone"})
        if not members:
            # Of what is not significant the nearest is that which chance makes least often, not that with the most parameters.
            chances = {name: (score.p_adjusted, score.p_single) for name, score in self.scores.items()}
            rejected.sort(key=lambda one: chances.get(one["name"], (1.0, 1.0)))
        correlations = {}
        if len(members) > 1 and not several:
            for k, a in enumerate(members):
                for b in members[k + 1:]:
                    correlations[f"{a.name} ~ {b.name}"] = canonical_correlation(self.space, a, b)
        # Where a number of the base explains the misfit, effects that would do as well are alternatives, none of them named.
        told = base_errors(self.space, members, self.inflation, self.coverage)
        if verdict == BASE_OFF:
            effects = []
        confusable = [m.name for m in members] if not several and len(members) > 1 else []
        base = self.space.base
        fit = members[0].fit if members else base
        warnings += [f"{p.description or p.name}: {fit.values[p.name]:.3g} {p.unit}, which is {abs(fit.values[p.name] - p.off) / p.prior:.1f} times"
                     f" what was assumed of it ({p.off:.3g} +- {p.prior:.2g}): the base model is off there"
                     for p in base.parameters if p.prior and not p.of_base and abs(fit.values[p.name] - p.off) > UNLIKELY * p.prior]
        plainly = {name: [r.candidates[-1].name for r in others] for name, others in alternatives.items()}
        return Diagnosis(verdict, effects, told, confusable, plainly, correlations, rejected, self.localisation.to_dict(), leftover,
                         float(captured), float(p_screen), float(p_local), held_out, {p.name: fit.values[p.name] for p in base.parameters},
                         {k: s.to_dict() for k, s in self.space.noise.streams.items()}, warnings, self.space.predictions.calls,
                         time.perf_counter() - self.started, reason,
                         Fits(self.space, list(members), list(rivals)), stand_ins=stand_ins)

    def stand_in(self, joint: Refit, first: Refit) -> StandIn:
        """What could stand in place of one that is named, the last of ``joint``."""
        candidate = joint.candidates[-1]
        numbers = {e.name: e for e in estimates(self.space, joint, self.coverage, self.inflation(joint))}
        worse = float(joint.fit.chi2 - first.fit.chi2)
        freed = self.beside_base(joint)
        told_of = {p.name: numbers[p.name].to_dict() | {"meaning": meaning(p)} | with_base(numbers[p.name], p, freed)
                   for p in by_weight(self.space, joint, candidate)}
        return StandIn(candidate.name, told_of, worse, why_not(joint, first, worse))

    def _gain_of(self, joint: Refit, candidate: Candidate) -> float:
        """What one of several effects adds to the others."""
        rest = self.fitted.get(frozenset(c.name for c in joint.candidates if c is not candidate))
        return drop_cost(joint, candidate) if rest is None else rest.fit.chi2 - joint.fit.chi2

    def _errors(
        self, judge: Callable[[Refit], HeldOut | None] | None, member: Refit, captured: float, held_out: dict[str, dict[str, Any]]
    ) -> tuple[float, float]:
        judged = judge(member) if judge else None
        if judged is not None:
            held_out[member.name] = {"before": judged.before, "after": judged.after, "rms": judged.rms, "p_after": judged.p_after, "unit": "noise"}
            return judged.before, judged.after
        base = sum(leave_condition_out(self.space, self.space.base).values())
        left = sum(leave_condition_out(self.space, member.fit).values())
        whole = member.gain / max(captured, 0.05)
        conditions = len(self.space.conditions)
        before = np.sqrt(1 + whole / conditions)
        after = np.sqrt(max(1 + (whole - (base - left)) / conditions, 1e-3))
        held_out[member.name] = {"before": float(before), "after": float(after), "unit": "noise", "kind": "leave one condition out"}
        return float(before), float(after)


def by_weight(space: Workspace, member: Refit, candidate: Candidate) -> list[Parameter]:
    """Parameters of an effect as they are told: amplitudes by how much each changes the fitted runs, calibrations taken out; then shapes."""
    fit, base = member.fit, space.base
    names = [p.name for p in fit.parameters]
    columns = project_out(fit.jacobian[:, [names.index(p.name) for p in candidate.amplitudes]], base.jacobian, base.normal)
    amounts = np.array([fit.values[p.name] - p.off for p in candidate.amplitudes])
    changes = np.linalg.norm(columns, axis=0) * np.abs(amounts)
    return [candidate.amplitudes[k] for k in np.argsort(-changes, kind="stable")] + list(candidate.shapes)


def meaning(p: Parameter) -> str:
    """What a parameter is, without where it is off."""
    return p.description.removesuffix(f" ({p.off:g}: off)")


def told_together(candidate: Candidate, numbers: Mapping[str, Estimate]) -> list[str]:
    """Of parameters of an effect that are told only in combination, that they are."""
    sets = dict.fromkeys(tuple(sorted([p.name, *numbers[p.name].others])) for p in candidate.parameters if numbers[p.name].others)
    return [
        f"{candidate.name}: the fitted runs tell {' and '.join(names)} only together, for what one has less another makes up for; each may be anywhere in its"
        " interval" for names in sets
    ]  # fmt: skip


def told_over(candidate: Candidate, member: Refit) -> list[str]:
    """Of amplitudes of an effect that are told only beside a number that is assumed, that they are, and how it is stated."""
    fit, texts = member.fit, []
    for k, j in carried(member):
        p, q = fit.parameters[k], fit.parameters[j]
        if any(p is a for a in candidate.amplitudes):
            alone = 1.0 / np.sqrt(fit.normal[k, k])
            texts.append(
                f"{candidate.name}: {p.name} is told only beside {q.name} ({q.description}), which is taken as {q.off:g} {q.unit} give or take {q.prior:g}: its"
                f" interval is that of {q.name}, with that known it is told to {100.0 * alone / abs(fit.values[p.name] - p.off):.1f} %; where it was"
                f' measured state it in campaign.toml, [nuisances.{q.name}] with unit = "{q.unit}", start, lower, upper and prior'
            )
    return texts


def with_base(estimate: Estimate, p: Parameter, freed: Mapping[str, Freed]) -> dict[str, Any]:
    """The interval with the base model's numbers free within their ranges, where that is another one."""
    # What the data say nothing about is not known less with them.
    beside = freed.get(p.name, Freed()) if np.isfinite(estimate.deviation) else Freed()
    core = estimate.core or (estimate.value, estimate.value)
    return {"interval_with_base": list(widened(estimate.interval, core, beside, (p.lower, p.upper)))} if beside.factor > WIDER else {}


def beside_first(member: Refit, members: Sequence[Refit]) -> tuple[float | None, str]:
    """By how much an alternative fits worse than the first of them, as a number and in words."""
    if len(members) < 2:
        return None, ""
    worse = float(member.fit.chi2 - members[0].fit.chi2)
    return worse, "" if member is members[0] else why_not(member, members[0], worse, members[0].name)


def why_not(rival: Refit, first: Refit, worse: float, than: str = "") -> str:
    """How a rival whose chi-square lies so much above that of what stands first compares to it, or to what it is called."""
    if abs(worse) < SAME_CHI2:
        return f"fits as well{than and f' as {than}'}"
    if worse > 0.0:
        return f"fits worse by {chi_text(worse)} in chi-square{than and f' than {than}'}"
    more = len(rival.own) - len(first.own)
    dear = f"{more} more parameter{'s' * (more > 1)}" if more > 0 else "values that are hardly likely" if penalised(rival) > penalised(first) else ""
    return f"fits better by {chi_text(-worse)} in chi-square{dear and f', with {dear}'}{than and f' than {than}'}"
