"""docs/blind_trial.md from the results of a trial."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.score import CHAIN, Case, calibration, cases_of, confusion, misses, null_levels, score

TARGETS = (
    # key, text, target, whether more is better
    ("false_alarms", "false alarms on data without an effect", 0.02, False),
    ("false_alarms_with_faults", "a part of the reducer blamed for a sensor's fault", 0.05, False),
    ("first_from_10", "right name first, d' from 10", 0.95, True),
    ("set_holds_6", "the set holds the truth, d' 6", 0.95, True),
    ("set_holds_from_10", "the set holds the truth, d' from 10", 0.99, True),
    ("one_name_is_right", "one name given is right", 0.98, True),
    ("pairs_both", "both of two effects in the set", 0.85, True),
    ("held_out_worse", "held-out error grows, d' from 10", 0.02, False),
)


def percent(value: float | None, digits: int = 1) -> str:
    return "-" if value is None else f"{100.0 * value:.{digits}f} %"


def number(value: float | None, digits: int = 2) -> str:
    return "-" if value is None else f"{value:.{digits}f}"


def table(head: list[str], rows: Sequence[Sequence[object]]) -> list[str]:
    return ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |",
            *("| " + " | ".join(str(x) for x in row) + " |" for row in rows), ""]  # fmt: skip


def publish(results: dict[int, dict[str, Any]], path: Path, about: dict[str, Any]) -> None:
    cases = cases_of(results)
    path.write_text("\n".join(page(results, cases, score(results), about)), encoding="utf-8")


def page(results: dict[int, dict[str, Any]], cases: list[Case], figures: dict[str, Any], about: dict[str, Any]) -> list[str]:
    lines = [
        "# Blind trial", "",
        "Made by `python -m benchmarks.blind_trial.run --publish`; do not edit.", "",
        f"{figures['campaigns']} campaigns, seed {about['seed']}, code {about['commit']}"
        + (f"; the trial was stopped before all {about['campaigns']}" if figures["campaigns"] + figures["not_made"] < about["campaigns"] else "")
        + (f"; {figures['not_made']} could not be made at the strength that was asked for" if figures["not_made"] else "") + ". " + about.get("note", ""), "",
        "Every truth was sealed (SHA-256 in the campaign and in `seals.txt`) before the diagnosis saw the folder. The generator has the plain"
        " reducer's kernels in common with the tool, and no code of any effect: other functional forms, other discretisation, its own noise"
        " (AR2 and ARMA, Student's t with 3 to 6 degrees of freedom, drift, offsets from run to run, quantisation). d' is the size of the"
        " hidden law in units of the true noise after what may be calibrated is projected out.", "",
        "## Targets", "",
    ]  # fmt: skip
    rows = []
    for key, text, target, more in TARGETS:
        f = figures[key]
        met = "-" if f["share"] is None else "met" if (f["share"] >= target if more else f["share"] <= target) else "**missed**"
        rows.append([text, f"{'at least' if more else 'at most'} {percent(target, 0)}", percent(f["share"]),
                     f"{percent(f['interval'][0], 0)} to {percent(f['interval'][1], 0)}", f["of"], met])  # fmt: skip
    for s, target in ((10.0, 0.80), (20.0, 0.97)):
        f = figures["outside"].get(s)
        if f:
            rows.append([f"truth outside the catalogue not plainly named, d' {s:g}", f"at least {percent(target, 0)}", percent(f["share"]),
                         f"{percent(f['interval'][0], 0)} to {percent(f['interval'][1], 0)}", f["of"],
                         "met" if f["share"] >= target else "**missed**"])  # fmt: skip
    size = figures["set_size"]
    rows.append(["mean size of the set, d' from 6", "at most 1.5", number(size), "", "", "-" if size is None else "met" if size <= 1.5 else "**missed**"])
    for s, target in ((12.0, 0.45), (20.0, 0.25)):
        f = figures["held_out"].get(s)
        if f and f["median_ratio"] is not None:
            rows.append([f"held-out error after/before, median, d' {s:g}", f"at most {target}", number(f["median_ratio"]), "", f["campaigns"],
                         "met" if f["median_ratio"] <= target else "**missed**"])  # fmt: skip
    c = figures["coverage"]
    if c["share"] is not None:
        rows.append(["95 % intervals hold the truth", "92 to 98 %", percent(c["share"]), f"{percent(c['interval'][0], 0)} to {percent(c['interval'][1], 0)}",
                     c["of"], "met" if 0.92 <= c["share"] <= 0.98 else "**missed**"])  # fmt: skip
    e = about.get("experiments")
    if e:
        gain = e["proposed"]["share"] / e["random"]["share"] if e["random"]["share"] else None
        rows.append(["a proposed experiment resolves, against a random one", "at least 3 times", number(gain) if gain else "random: none",
                     f"{e['proposed']['count']} against {e['random']['count']}", e["random"]["of"],
                     "met" if e["proposed"]["count"] >= 3 * max(e["random"]["count"], 1) else "**missed**"])  # fmt: skip
    lines += table(["", "target", "reached", "95 % interval", "of", ""], rows)
    lines += [f"Crashes: {len(figures['crashes'])}. One name given, whatever was hidden (null, outside, faults, pairs too): right in "
              f"{percent(figures['one_name_is_right_all_kinds']['share'])} of {figures['one_name_is_right_all_kinds']['of']}. "
              f"Any answer but none with a sensor's fault: {percent(figures['any_answer_with_faults']['share'])}. "
              f"Right name first, d' from 10, where the answer is no set: {percent(figures['first_without_set']['share'])} of "
              f"{figures['first_without_set']['of']}. "
              f"At least one of two effects named: {percent(figures['pairs_one']['share'])}. Wrong base, not misnamed plainly: "
              f"{percent(figures['wrong_base_not_misnamed']['share'])} of {figures['wrong_base_not_misnamed']['of']}. Poor designs (two levels, "
              f"nothing held out, part without replicates): set holds the truth {percent(figures['poor']['set'])}, plainly misnamed "
              f"{percent(figures['poor']['misnamed'])} of {figures['poor']['campaigns']}; false alarms "
              f"{percent(figures['false_alarms_poor']['share'])} of {figures['false_alarms_poor']['of']}.", "",
              f"Time of a diagnosis, with other jobs on the machine: median {number(figures['seconds']['median'], 1)} s, 90 % within "
              f"{number(figures['seconds']['90 %'], 1)} s, longest {number(figures['seconds']['longest'], 1)} s.", ""]  # fmt: skip
    lines += ["## One hidden effect, by strength", ""]
    lines += table(["d'", "campaigns", "detected", "right name first", "set holds it", "set's size", "held-out after/before (median)", "held-out worse", "verdicts"], [
        [f"{s:g}", f["campaigns"], percent(f["detected"], 0), percent(f["first"], 0), percent(f["set"], 0), number(f["size"]),
         number(figures["held_out"][s]["median_ratio"]), percent(figures["held_out"][s]["worse"], 0),
         ", ".join(f"{k} {v}" for k, v in sorted(f["verdicts"].items()))]
        for s, f in figures["by_strength"].items()])  # fmt: skip
    lines += ["## Outside the catalogue", ""]
    lines += table(["law", *(f"d' {s:g}" for s in figures["outside"])], outside_rows(cases, list(figures["outside"])))
    lines += ["## Confusion", "", "Rows: hidden. Columns: named first, or the verdict where no name is given. Pairs and wrong bases left out.", ""]
    lines += confusion_table(cases)
    lines += ["## Calibration", ""]
    lines += table(["share captured, as stated", "right name first", "of"], [
        [f"{row['low']:g} to {row['high']:g}", percent(row["share"], 0), row["of"]] for row in calibration(cases)])
    lines += table(["level", "null campaigns whose screening is below", "whose localisation is below"], [
        [f"{level:g}", percent(a, 1), percent(b, 1)] for level, a, b in null_levels(cases)])
    lines += peers_section(cases)
    wrong = misses(cases)
    lines += [f"## Every miss ({len(wrong)})", "", "Make one again: `python -m benchmarks.blind_trial.run --seed SEED --numbers NUMBER --keep`.", ""]
    lines += table(["campaign", "kind", "size", "d'", "hidden", "answer", "named", "captured"], [
        [c.number, c.kind, c.size, f"{c.strength:g}", " + ".join(c.laws) or c.truth["fault"] or "nothing", c.verdict,
         ", ".join(e["name"] for e in c.answer["effects"]) or c.answer.get("error", ""), percent(c.answer.get("captured"), 0)] for c in wrong])
    return lines


def outside_rows(cases: list[Case], strengths: list[float]) -> list[list[str]]:
    laws = sorted({c.laws[0] for c in cases if c.kind == "outside"})
    rows = []
    for law in laws:
        row = [law]
        for s in strengths:
            row.append("; ".join(c.verdict + (f": {c.names[0]}" if c.names and c.verdict != "unknown" else "")
                                 for c in cases if c.kind == "outside" and c.laws[0] == law and c.strength == s) or "-")
        rows.append(row)
    return rows


def confusion_table(cases: list[Case]) -> list[str]:
    found = confusion(cases)
    said = sorted({name for row in found.values() for name in row}, key=lambda n: (n.startswith("("), n in CHAIN, n))
    short = {name: name.replace("_", " ") for name in said}
    rows = []
    for row in sorted(found, key=lambda n: (n.startswith("("), n)):
        rows.append([row.replace("_", " "), *(f"**{found[row][n]}**" if n == row else found[row][n] or "" for n in said)])
    return table(["hidden", *(short[n] for n in said)], rows)


def peers_section(cases: list[Case]) -> list[str]:
    with_peers = [c for c in cases if c.result.get("peers")]
    if not with_peers:
        return []
    lines = ["## The same files put through other methods", "",
             "BIC with white noise over the same candidates; PySINDy's STLSQ on the same columns; PEtab Select's forward method"
             " with AIC and BIC. None of them can say that nothing is missing unless no term enters, and none that the law is unknown.", ""]  # fmt: skip
    names = sorted({name for c in with_peers for name in c.result["peers"] if "seconds" not in name})
    rows = []

    def right(c: Case, method: str) -> bool:
        named = c.result["peers"].get(method) or []
        return bool(named) and named[0].partition(".")[0] in c.acceptable

    for method in names:
        nulls = [c for c in with_peers if c.kind == "null" and method in c.result["peers"]]
        effects = [c for c in with_peers if c.kind == "effect" and c.strength >= 10 and method in c.result["peers"]]
        outside = [c for c in with_peers if c.kind == "outside" and method in c.result["peers"]]
        rows.append([method, f"{sum(bool(c.result['peers'][method]) for c in nulls)} of {len(nulls)}",
                     f"{sum(right(c, method) for c in effects)} of {len(effects)}",
                     f"{sum(bool(c.result['peers'][method]) and not right(c, method) for c in outside)} of {len(outside)}"])
    nulls = [c for c in with_peers if c.kind == "null"]
    effects = [c for c in with_peers if c.kind == "effect" and c.strength >= 10]
    outside = [c for c in with_peers if c.kind == "outside"]
    rows.append(["this diagnosis", f"{sum(c.verdict != 'none' for c in nulls)} of {len(nulls)}", f"{sum(c.first for c in effects)} of {len(effects)}",
                 f"{sum(c.plainly and not c.first for c in outside)} of {len(outside)}"])
    return lines + table(["method", "names something on null data", "right name first, d' from 10", "names something plainly for a law outside the catalogue"], rows)
