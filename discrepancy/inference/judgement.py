"""Is it enough: what a fit leaves, what runs say that were not used, and by how much that widens intervals."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from discrepancy.inference.base_fit.squares import usual_chance
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.held_out.consistency import lack_of_fit
from discrepancy.inference.held_out.held_out import WITHIN_NOISE, HeldOut, HeldOutJudge
from discrepancy.inference.misfit.localise import Localisation, Localiser
from discrepancy.inference.refit.confusable import is_settled, penalised
from discrepancy.inference.refit.refit import Refit, leave_condition_out

# Of chi-square that unused runs gain of noise alone in one campaign in twenty.
CONFIRMING = 6.0
# Of the level from which on a name needs nothing more, where unused runs refute it (assumed).
REFUTED = 0.1
# Of so many conditions none can be left out: what two effects do is then known from one alone.
FEW_CONDITIONS = 2


def grew(judged: HeldOut | None) -> bool:
    """Whether runs that were not fitted are explained worse with what is named, and by more than noise."""
    return judged is not None and judged.seen and judged.after > max(judged.before, WITHIN_NOISE)


def against(judged: HeldOut | None) -> str:
    """What runs that were not fitted say against what is named; empty if nothing."""
    if judged is None:
        return ""
    if grew(judged):
        became = f"the misfit in the patterns grew from {judged.before:.2f} to {judged.after:.2f}"
        return f"on runs that were not used {became}: what is named fits, it does not explain"
    if judged.p_after < 0.0005 and judged.after > 1.5:
        return "runs that were not used are not explained: their error is far above their noise"
    return ""


def borne_out(p: float, judged: HeldOut | None, sure: float, level: float) -> bool:
    """Whether what is significant at ``p`` may be named: below ``sure`` as it is, far below where unused runs speak against it, else as far as those that
    would show it agree.

    Of noise alone they gain more than x in chi-square in no more than exp(-x/2) of campaigns (Markov, of a likelihood ratio).
    """
    if p < sure:
        return p < REFUTED * sure or not grew(judged)
    if judged is None or not judged.seen:
        return p < level
    return judged.gain > (0.0 if p < level else CONFIRMING)


def widening(over: bool, inflation: float) -> float:
    """Of intervals, for a misfit that is ``over`` the noise by this factor in chi-square; twice at most."""
    return float(np.sqrt(min(inflation, 4.0))) if over else 1.0


@dataclass(frozen=True)
class Weighed:
    """What all runs together say of fits, by the names of their effects: of each what unused ones say, over directions that all have in common;
    ``margin`` in chi-square from which one is less likely."""

    judged: Mapping[frozenset[str], tuple[Refit, HeldOut]]
    margin: float

    def whole(self, result: Refit) -> float:
        """Chi-square of all runs with the price of what is fitted, of those that were not used as well as the fit can know them."""
        return penalised(result) + self.judged[result.key][1].surprise

    def refuted(self, result: Refit, first: Refit) -> bool:
        """Whether unused runs speak against ``result``, and all runs together for ``first`` instead."""
        known = result.key in self.judged and first.key in self.judged
        return known and bool(against(self.judged[result.key][1])) and self.whole(result) > self.whole(first) + self.margin

    def likeliest(self, final: Refit) -> Refit:
        """``final``, or the plain fit that all runs together speak for where unused ones refute ``final``; they may not be explained by that either."""
        best = min((r for r, _ in self.judged.values() if is_settled(r)), key=self.whole, default=final)
        return best if self.refuted(final, best) else final


class Judgement:
    """Judges fits on the runs that were fitted and on those that were not; ``level`` is that of what a fit leaves."""

    # Localisation of the base model's misfit.
    localisation: Localisation

    def __init__(self, space: Workspace, orders: Mapping[str, Sequence[float]], level: float):
        self.space, self.orders, self.level = space, orders, level
        self.inflations: dict[frozenset[str], float] = {}

    def __getstate__(self) -> dict[str, Any]:
        """Without the large tables of its tests, which are made anew where they are asked for."""
        return {k: v for k, v in self.__dict__.items() if k != "localiser"}

    @cached_property
    def localiser(self) -> Localiser:
        return Localiser(self.space, self.orders)

    def leftover(self, result: Refit) -> tuple[bool, float, dict[str, Any], float]:
        """Whether ``result`` leaves a significant misfit, its size, what it is, and its inflation."""
        local = self.localiser.test(result.fit, self.level, likely=usual_chance)
        shape = lack_of_fit(self.space, result)
        worst: dict[str, float] = {}
        inflation = 1.0
        for g in local.findings:
            worst[g.signal] = max(worst.get(g.signal, 0.0), g.statistic - g.width)
            inflation = max(inflation, g.statistic / g.width)
        failing = {k: v for k, v in shape.items() if v[2] < self.level}
        size = max(sum(worst.values()), max((s - w for s, w, _ in failing.values()), default=0.0))
        inflation = max([inflation, *(s / w for s, w, _ in failing.values())])
        text: dict[str, Any] = {"findings": [{"signal": g.signal, "feature": g.feature, "dependence": g.dependence, "p": g.p} for g in local.largest],
                "dependence": {k: {"statistic": s, "width": w, "p": p} for k, (s, w, p) in shape.items()}}
        return bool(worst or failing), size, text, inflation

    def inflation(self, result: Refit) -> float:
        """By how much the intervals of ``result`` widen for a misfit that it leaves."""
        key = result.key
        if key not in self.inflations:
            over, _, _, inflation = self.leftover(result)
            self.inflations[key] = widening(over, inflation)
        return self.inflations[key]

    def held_out(self, rivals: Sequence[Refit]) -> HeldOutJudge:
        """A judge over runs that were not used, in directions that these have in common."""
        return HeldOutJudge(self.space, self.localisation, rivals, self.orders)

    def alone(self, result: Refit) -> HeldOut | None:
        """What unused runs say of a fit, as they will when it is added to the model: rivals are compared in common, over other patterns."""
        return self.held_out([result]).judge(result) if self.space.held_out else None

    def weighed(self, final: Refit, near: Sequence[Refit], margin: float) -> Weighed:
        """What all runs together say of ``final`` and of fits that are hardly worse on those that were fitted."""
        if not near or not self.space.held_out:
            return Weighed({}, margin)
        fits = [final, *near]
        judge = self.held_out(fits)
        return Weighed({r.key: (r, judged) for r in fits if (judged := judge.judge(r)) is not None}, margin)

    def is_whole(self, joint: Refit) -> bool:
        """Whether a fit leaves nothing of runs of which none can be left out."""
        return not self.space.held_out and len(self.space.conditions) <= FEW_CONDITIONS and not self.leftover(joint)[0]

    def foretells(self, joint: Refit, current: Refit) -> bool:
        """Whether runs that were not fitted, or where these show no difference conditions left out in turn, are nearer to ``joint`` than to ``current``."""
        if self.space.held_out:
            judge = self.held_out([joint, current])
            if judge.tells(joint, current):
                after, before = judge.judge(joint), judge.judge(current)
                if after is not None and before is not None:
                    return after.after < before.after
        left = [sum(leave_condition_out(self.space, r.fit).values()) for r in (joint, current)]
        return left[0] < left[1]
