"""docs/blind_trial.md from the results of a trial."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.score import CHAIN, Case, calibration, cases_of, confusion, effect_of, misses, null_levels, score
from benchmarks.blind_trial.targets import APART, reached
from benchmarks.blind_trial.words import UNKNOWN


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
    if (e := about.get("experiments")) and e["random"]["of"]:
        # A random one that never resolved counts as once.
        figures["judged"]["experiments"] = {"share": e["proposed"]["count"] / max(e["random"]["count"], 1), "of": e["random"]["of"]}
    apart = figures["apart"]
    rows = []
    for r in reached(figures):
        between = "" if r.interval is None else f"{percent(r.interval[0], 0)} to {percent(r.interval[1], 0)}"
        without = "" if r.without is None or not apart["known"] else f"{r.target.told(r.without[0])} of {r.without[1]}"
        rows.append([r.target.text, r.target.level, r.target.told(r.value), between, r.of, r.verdict, without])
    lines += table(["", "target", "reached", "95 % interval", "of", "", "without what no test can tell"], rows)
    lines += apart_section(apart, figures["apart_outside"])
    lines += experiments_section(about.get("experiments"))
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
              f"{number(figures['seconds']['90 %'], 1)} s, longest {number(figures['seconds']['longest'], 1)} s. Making, diagnosing and judging them took {figures['cpu'] / 3600.0:.1f} h of CPU.", ""]  # fmt: skip
    lines += ["## By base model, size and trouble", ""]
    for title, key in (("base model", "by_base"), ("size", "by_size")):
        lines += table([title, "campaigns", "false alarms", "right name first, d' from 10", "set holds it", "set's size", "seconds (median)"], [
            [kind, f["all"], alarms_of(f["alarms"]), percent(f["first"], 0), percent(f["set"], 0), number(f["size"]), number(f["seconds"], 1)]
            for kind, f in figures[key].items()])  # fmt: skip
    lines += table(["data without an effect", "false alarms", "95 % interval"], [
        [name or "nothing is wrong", alarms_of(f), f"{percent(f['interval'][0], 0)} to {percent(f['interval'][1], 0)}"]
        for name, f in figures["alarms_by_trouble"].items() if f["of"]])  # fmt: skip
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
    lines += [f"## Every miss ({len(wrong)})", "", f"Make one again: `python -m benchmarks.blind_trial.run {'--final' if about.get('final') else '--seed SEED'} --numbers NUMBER --folder /tmp/x --keep`.", ""]
    lines += table(["campaign", "kind", "size", "d'", "hidden", "answer", "named", "captured"], [
        [c.number, c.kind, c.size, f"{c.strength:g}", " + ".join(c.laws) or c.truth["fault"] or "nothing", c.verdict,
         ", ".join(e["name"] for e in c.answer["effects"]) or c.answer.get("error", ""), percent(c.answer.get("captured"), 0)] for c in wrong])
    return lines


def alarms_of(f: dict[str, Any]) -> str:
    return f"{f['count']} of {f['of']}" if f["of"] else "-"


def apart_section(apart: dict[str, Any], outside: dict[str, int]) -> list[str]:
    """What the best possible test could not tell, said at the targets."""
    if not apart["campaigns"]:
        return []
    effects = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in sorted(apart["effects"].items(), key=lambda x: -x[1]))
    return [f"In {apart['campaigns']} of {apart['known']} campaigns of one effect for which it was reckoned, the nearest law of another effect, with its own"
            f" strength, shape and calibration, is less than d' = {APART:g} away from the truth: by Neyman and Pearson even a test that is told both errs in more"
            f" than 7 of 100 such campaigns. They are: {effects}. In these the right name stands first in {percent(apart['first'], 0)}, the set holds it"
            f" in {percent(apart['set'], 0)} (mean size {number(apart['size'])}), one wrong name is given plainly in {percent(apart['misnamed'], 0)}."
            + (" Laws outside the catalogue as near to one of its effects: " + ", ".join(f"{k} {v}" for k, v in outside.items()) + "." if outside else ""),
            ""]  # fmt: skip


def experiments_section(found: dict[str, Any] | None) -> list[str]:
    """How often one more experiment leaves one right name, by who chose it."""
    if not found:
        return []
    lines = ["One more experiment, chosen on the same campaigns from all that the rig can do, leaves one right name:", ""]
    return lines + table(["chosen by", "resolved", "95 % interval"], [
        [name, f"{f['count']} of {f['of']}", f"{percent(f['interval'][0], 0)} to {percent(f['interval'][1], 0)}"] for name, f in found.items()])


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


# What a method says of a campaign: names, best first; UNKNOWN alone is an alarm without a name; None: it was not asked.
Says = Callable[[Case], Sequence[str] | None]


def of_peer(method: str) -> Says:
    return lambda c: c.result["peers"].get(method)


def of_this(c: Case) -> list[str]:
    return [] if not c.alarm else c.names if c.plainly or c.first else [UNKNOWN]


def peer_row(method: str, says: Says, cases: list[Case]) -> list[str]:
    """What a method makes of data without an effect, with one, and with a law outside the catalogue."""

    def right(names: Sequence[str], c: Case) -> bool:
        return bool(names) and effect_of(names[0]) in c.acceptable

    def share(kind: str, holds: Callable[[Sequence[str], Case], bool]) -> str:
        asked = [(names, c) for c in cases if c.kind == kind and (kind != "effect" or c.strength >= 10.0) and (names := says(c)) is not None]
        return f"{sum(holds(names, c) for names, c in asked)} of {len(asked)}"

    def alarm(names: Sequence[str], c: Case) -> bool:
        return bool(names)

    return [method, share("null", alarm), share("effect", alarm), share("effect", right), share("outside", alarm),
            share("outside", lambda names, c: bool(names) and list(names) != [UNKNOWN] and not right(names, c))]  # fmt: skip


def peers_section(cases: list[Case]) -> list[str]:
    with_peers = [c for c in cases if c.result.get("peers")]
    if not with_peers:
        return []
    lines = ["## The same files put through other methods", "",
             "BIC with white noise over the same candidates; PySINDy's STLSQ on the same columns; PEtab Select's forward method"
             " with AIC and BIC; sbi's two tests for misspecification, which name nothing. Those that name terms say that nothing is missing only where no"
             " term enters, and never that the law is unknown.", ""]  # fmt: skip
    methods = sorted({name for c in with_peers for name in c.result["peers"]} - {"seconds", "error"})
    rows = [peer_row(method, of_peer(method), with_peers) for method in methods] + [peer_row("this diagnosis", of_this, with_peers)]
    return lines + table(["method", "alarms, data without an effect", "alarms, one effect, d' from 10", "right name first, d' from 10",
                          "alarms, law outside the catalogue", "names something plainly for a law outside the catalogue"], rows)  # fmt: skip
