"""What the answers are worth: figures of a trial against the unsealed truths.

    python -m benchmarks.blind_trial.score answers.json --trial OPEN --sealed TRUTHS      # an answers file of the open trial
"""

import argparse
import json
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from benchmarks.blind_trial.answers import read_answers, results_of
from benchmarks.blind_trial.generator.make import LAWS
from benchmarks.blind_trial.generator.reducer import RIGID
from benchmarks.blind_trial.generator.trouble import BASES, NOISES
from benchmarks.blind_trial.targets import APART, reached
from benchmarks.blind_trial.words import BASE_OFF, CRASH, INCOMPLETE, NONE, ONE, SET, SEVERAL

T = TypeVar("T")
PLAIN = (ONE, SEVERAL)
CHAIN = ("sensor_gain", "sensor_offset", "sensor_drift", "clock_slip", "encoder_eccentricity")


def effect_of(name: str) -> str:
    """The effect of a candidate's name: what stands before the dot."""
    return name.partition(".")[0]


def meant(law: dict[str, Any]) -> dict[str, float]:
    """Parameters of the catalogue that mean the same as numbers of a hidden law, which are sealed."""
    truth = object.__new__(LAWS[law["law"]])
    truth.__dict__.update({k: np.asarray(v) if isinstance(v, list) else v for k, v in law["numbers"].items()})
    return truth.parameters()


class Case:
    """One campaign: what was hidden and what was answered, by effect."""

    def __init__(self, result: dict[str, Any]):
        truth, answer = result["truth"], result["answer"]
        self.result, self.truth, self.answer = result, truth, answer
        self.number: int = result["number"]
        self.kind: str = truth["kind"]
        self.size: str = truth["size"]
        self.strength: float = truth["strength"]
        # Of the base model; a trial before there were several had one.
        self.base: str = truth.get("reducer", RIGID)
        self.laws: list[str] = [law["law"] for law in truth["laws"]]
        self.effects: list[str] = [e for e in truth["effects"] if e]
        self.acceptable = set(truth["acceptable"]) | set(self.effects)
        self.verdict: str = answer["verdict"]
        self.names = list(dict.fromkeys(effect_of(e["name"]) for e in answer["effects"]))
        if self.verdict not in (NONE, CRASH):
            # A law that is a number of the reducer file is named by that as well as by the effect, alone or beside another one.
            off = {e["name"] for e in answer.get("base_off", [])}
            self.names += [law["effect"] for law in truth["laws"] if off & set(LAWS[law["law"]].numbers) and law["effect"] not in self.names]
        more = [effect_of(n) for n in answer.get("confusable", [])]
        more += [effect_of(n) for names in answer.get("alternatives", {}).values() for n in names]
        self.set = list(dict.fromkeys(self.names + more)) if self.verdict != NONE else []
        self.trouble: str = truth.get("trouble", "")
        # d' between the truth and the nearest law of another effect, where that was reckoned.
        self.nearest: float | None = min(truth.get("rivals", {}).values(), default=None)
        self.seconds: float = answer["times"]["whole"]
        self.cpu: float = result.get("cpu", {}).get("whole", 0.0)

    @property
    def told(self) -> bool:
        """Whether the best possible test could tell the truth from every other effect, as far as known."""
        return self.nearest is None or self.nearest >= APART

    @property
    def alarm(self) -> bool:
        """Something is named, or said to be missing, where nothing is."""
        return self.verdict != NONE and not (self.verdict == BASE_OFF and self.trouble in BASES)

    @property
    def first(self) -> bool:
        """The right name stands first."""
        return self.verdict not in (NONE, CRASH) and bool(self.names) and self.names[0] in self.acceptable

    @property
    def covered(self) -> bool:
        """Every hidden effect is in what was named."""
        return self.verdict not in (NONE, CRASH) and all(e in self.set for e in self.effects)

    @property
    def plainly(self) -> bool:
        return self.verdict in PLAIN

    @property
    def names_something(self) -> bool:
        """Something is named, whole or in part."""
        return self.verdict in (ONE, SET, SEVERAL, INCOMPLETE)

    @property
    def physical_alarm(self) -> bool:
        """A part of the reducer is blamed, plainly or as a set without any sensor."""
        return self.verdict in (ONE, SEVERAL, SET) and bool(self.set) and not any(n in CHAIN for n in self.set)

    @property
    def held_out(self) -> tuple[float, float] | None:
        """Error on unused conditions before and after what stands first."""
        for e in self.answer["effects"][:1]:
            before, after = e.get("held_out_error_before"), e.get("held_out_error_after")
            if before is not None and after is not None and before > 0.0:
                return before, after
        return None

    def coverage(self) -> Iterable[tuple[str, bool, bool]]:
        """(parameter, whether its interval holds the truth, whether the answer was plain)."""
        for law in self.truth["laws"]:
            for name, value in meant(law).items():
                for e in self.answer["effects"]:
                    entry = e["parameters"].get(name)
                    if entry and entry.get("interval"):
                        yield name, entry["interval"][0] <= value <= entry["interval"][1], self.verdict == ONE


def share(cases: Sequence[T], test: Callable[[T], object]) -> float | None:
    return float(np.mean([bool(test(c)) for c in cases])) if cases else None


def wilson(k: float, n: int, z: float = 1.96) -> tuple[float, float]:
    """Interval of a share."""
    if n == 0:
        return 0.0, 1.0
    middle = (k + 0.5 * z * z) / (n + z * z)
    half = z / (n + z * z) * np.sqrt(k * (n - k) / n + 0.25 * z * z)
    return max(0.0, middle - half), min(1.0, middle + half)


def cases_of(results: dict[int, dict[str, Any]]) -> list[Case]:
    return [Case(r) for _, r in sorted(results.items()) if "truth" in r]


def score(results: dict[int, dict[str, Any]]) -> dict[str, Any]:
    """All figures as plain data; ``judged`` are those that have a target, ``told_apart`` the same of what can be told."""
    cases = cases_of(results)
    of: dict[str, list[Case]] = defaultdict(list)
    for c in cases:
        of[c.kind].append(c)
    nulls, faults, outside, pairs = of["null"], of["fault"], of["outside"], of["pair"]
    single = [c for c in of["effect"] if c.size != "poor"]
    strong = [c for c in single if c.strength >= 10]
    strengths = sorted({c.strength for c in of["effect"]})
    poor = [c for c in of["effect"] if c.size == "poor"]
    figures: dict[str, Any] = {
        "campaigns": len(cases), "not_made": sum("not_made" in r for r in results.values()),
        "small": sum(c.size in ("tiny", "small", "poor") for c in cases),
        "crashes": [(c.number, c.answer.get("error", "")) for c in cases if c.verdict == CRASH],
        "judged": judged(cases) | {
            "false_alarms": counted(nulls, lambda c: c.alarm),
            "false_alarms_with_faults": counted(faults, lambda c: c.physical_alarm),
            "held_out_worse": counted([c for c in strong if c.held_out and c.names_something], lambda c: c.held_out is not None and c.held_out[1] > c.held_out[0]),
            "coverage": counted([x for c in cases for x in c.coverage() if x[2]], lambda x: x[1]),
        },
        "told_apart": judged([c for c in cases if c.told]),
        "apart": apart(single), "apart_outside": dict(Counter(c.laws[0] for c in outside if not c.told)),
        "alarms_by_trouble": {name: counted([c for c in nulls if c.trouble == name and c.size != "poor"], lambda c: c.alarm)
                              for name in ("", *BASES, *NOISES)},
        "false_alarms_poor": counted([c for c in nulls if c.size == "poor"], lambda c: c.alarm),
        "any_answer_with_faults": counted(faults, lambda c: c.verdict != NONE),
        "one_name_is_right_all_kinds": counted([c for c in cases if c.verdict == ONE], lambda c: c.names[0] in c.acceptable),
        "first_without_set": counted([c for c in strong if c.verdict != SET], lambda c: c.first),
        "pairs_one": counted(pairs, lambda c: any(e in c.set for e in c.effects)),
        "wrong_base_not_misnamed": counted(of["wrong base"], lambda c: not c.plainly or c.first),
        "by_strength": {}, "by_size": {}, "by_base": {}, "outside": {}, "held_out": {},
        "poor": {"campaigns": len(poor), "set": share(poor, lambda c: c.covered), "misnamed": share(poor, lambda c: c.plainly and not c.first)},
        "seconds": {"median": quantile(cases, 0.5), "90 %": quantile(cases, 0.9), "longest": quantile(cases, 1.0)},
        "cpu": sum(c.cpu for c in cases),
    }  # fmt: skip
    for s in strengths:
        here = [c for c in single if c.strength == s]
        figures["by_strength"][s] = {"verdicts": dict(Counter(c.verdict for c in here)), **found_in(here)}
        errors = [c.held_out for c in here if c.names_something and c.held_out]
        figures["held_out"][s] = {"campaigns": len(errors), "median_ratio": mean([b / a for a, b in errors], np.median),
                                  "worse": mean([b > a for a, b in errors])}  # fmt: skip
        figures["judged"][f"held_out_{s:g}"] = {"share": figures["held_out"][s]["median_ratio"], "of": len(errors)}
    for key, own in (("by_size", "size"), ("by_base", "base")):
        for kind in sorted({getattr(c, own) for c in cases}):
            those = [c for c in cases if getattr(c, own) == kind]
            here = [c for c in those if c.kind == "effect" and c.strength >= 10]
            alarms = counted([c for c in nulls if getattr(c, own) == kind], lambda c: c.alarm)
            figures[key][kind] = {"all": len(those), "alarms": alarms, **found_in(here), "seconds": quantile(those, 0.5)}
    for s in sorted({c.strength for c in outside}):
        figures["outside"][s] = figures["judged"][f"outside_{s:g}"]
    return figures


def judged(cases: Sequence[Case]) -> dict[str, dict[str, Any]]:
    """What is asked of single effects, of pairs and of laws outside the catalogue."""
    outside = [c for c in cases if c.kind == "outside"]
    single = [c for c in cases if c.kind == "effect" and c.size != "poor"]
    strong = [c for c in single if c.strength >= 10]
    named_once = [c for c in cases if c.verdict == ONE and c.kind in ("effect", "wrong base")]
    sizes = [len(c.set) for c in single if c.verdict in (ONE, SET) and c.strength >= 6]
    return {
        "first_from_10": counted(strong, lambda c: c.first), "set_holds_from_10": counted(strong, lambda c: c.covered),
        "set_holds_6": counted([c for c in single if c.strength == 6], lambda c: c.covered),
        "one_name_is_right": counted(named_once, lambda c: c.names[0] in c.acceptable),
        "pairs_both": counted([c for c in cases if c.kind == "pair"], lambda c: c.covered),
        "set_size": {"share": mean(sizes), "of": len(sizes)},
        **{f"outside_{s:g}": counted([c for c in outside if c.strength == s], lambda c: not c.plainly or c.first)
           for s in sorted({c.strength for c in outside})},
    }  # fmt: skip


def apart(single: Sequence[Case]) -> dict[str, Any]:
    """Campaigns whose truth no test can tell from its nearest rival, by hidden effect."""
    known = [c for c in single if c.nearest is not None]
    here = [c for c in known if not c.told]
    return {"known": len(known), "campaigns": len(here), **found_in(here), "effects": dict(Counter(c.effects[0] for c in here)),
            "misnamed": share(here, lambda c: c.plainly and not c.first)}  # fmt: skip


def found_in(cases: Sequence[Case]) -> dict[str, Any]:
    """How single effects were found."""
    return {"campaigns": len(cases), "first": share(cases, lambda c: c.first), "set": share(cases, lambda c: c.covered),
            "detected": share(cases, lambda c: c.verdict != NONE), "size": mean([len(c.set) for c in cases if c.verdict in (ONE, SET)])}


def counted(cases: Sequence[T], test: Callable[[T], object]) -> dict[str, Any]:
    """Share of cases that pass, with its 95 % interval."""
    k = sum(bool(test(c)) for c in cases)
    return {"share": k / len(cases) if cases else None, "of": len(cases), "count": k, "interval": wilson(k, len(cases))}


def mean(values: Sequence[float], how: Callable[[Sequence[float]], float] = np.mean) -> float | None:
    return float(how(values)) if values else None


def quantile(cases: list[Case], q: float) -> float | None:
    return mean([c.seconds for c in cases], lambda x: np.quantile(x, q))


def confusion(cases: list[Case]) -> dict[str, Counter[str]]:
    """Hidden effect (or kind) against what was said: name, or verdict where none is given."""
    table: dict[str, Counter[str]] = defaultdict(Counter)
    for c in cases:
        if c.kind in ("pair", "wrong base"):
            continue
        row = c.effects[0] if c.kind == "effect" else f"({c.kind})"
        said = c.names[0] if c.verdict in (ONE, SET, SEVERAL, INCOMPLETE) and c.names else f"({c.verdict})"
        table[row][said] += 1
    return dict(table)


def calibration(cases: list[Case]) -> list[dict[str, Any]]:
    """Share of right first names by what the diagnosis says it captures; p-values of the screening on null data."""
    rows = []
    for low, high in ((0.0, 0.7), (0.7, 0.8), (0.8, 0.9), (0.9, 0.97), (0.97, 1.01)):
        here = [c for c in cases if c.kind in ("effect", "outside") and c.names and low <= c.answer.get("captured", 0.0) < high]
        rows.append({"low": low, "high": min(high, 1.0), **counted(here, lambda c: c.first)})
    return rows


def null_levels(cases: list[Case]) -> list[tuple[float, float, float]]:
    """(level, share of null campaigns with a smaller p of the screening, of the localisation)."""
    nulls = [c for c in cases if c.kind == "null" and "p_screen" in c.answer]
    return [(level, share(nulls, lambda c: c.answer["p_screen"] < level) or 0.0, share(nulls, lambda c: c.answer["p_localise"] < level) or 0.0)
            for level in (0.5, 0.2, 0.1, 0.05, 0.01)] if nulls else []  # fmt: skip


def misses(cases: list[Case]) -> list[Case]:
    """Everything that was not as it should be, strong effects first."""

    def wrong(c: Case) -> bool:
        if c.verdict == CRASH:
            return True
        if c.kind == "null":
            return c.alarm
        if c.kind == "fault":
            return c.physical_alarm
        if c.kind == "outside":
            return c.plainly and not c.first
        if c.kind == "wrong base":
            return c.plainly and not c.first
        return not c.covered or (c.kind == "effect" and not c.first)

    return sorted((c for c in cases if wrong(c)), key=lambda c: (c.kind, -c.strength, c.number))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("answers", type=Path, nargs="+", help="answers files")
    parser.add_argument("--trial", type=Path, required=True, help="folder of the open trial, with seals.txt")
    parser.add_argument("--sealed", type=Path, required=True, help="folder of the truths")
    parser.add_argument("--json", action="store_true", help="all figures as data")
    arguments = parser.parse_args()
    for path in arguments.answers:
        method, answers = read_answers(path)
        figures = score(results_of(answers, arguments.trial, arguments.sealed))
        if arguments.json:
            print(json.dumps({"method": method, **figures}, indent=1, default=float))
            continue
        print(f"{method}: {len(answers)} answers to {figures['campaigns']} campaigns")
        for r in reached(figures):
            without = "" if r.without is None else f"; {r.target.told(r.without[0])} of {r.without[1]} without what no test can tell"
            print(f"  {r.target.text}: {r.target.told(r.value)} of {r.of} ({r.target.level}: {r.verdict.strip('*')}){without}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
