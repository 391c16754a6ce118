"""Numbers of conditions that a bench measured: runs whose own hardly differ belong to one condition, each keeping its own."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeGuard

from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Doubt, Guess, SpeedBySize
from discrepancy.campaign.guess.set_steps import MEASURED, SHARE_STEP, TEMPERATURE_STEP, spans_no_step, step_at
from discrepancy.campaign.guess.wishes import Wishes


def with_given_instead(runs: Sequence[GuessedRun], wishes: Wishes) -> list[GuessedRun]:
    """What is given for all files wins over what lines above their tables say, which is said where that is something else."""
    found = []
    for run in runs:
        given = {("put_speed" if key.endswith("put_speed") else key): (key, text) for key, text in wishes.for_all.items()}
        factors, doubts = dict(run.factors), list(run.doubts)
        for key in run.above:
            if pair := given.get("put_speed" if key.endswith("put_speed") else key):
                own = factors.pop(key).value
                doubts = [doubt for doubt in doubts if not is_of(doubt, own, key)]
                if not (pair[0] == key and near(key, own, pair[1])):
                    text = f"a line above its table says {key} = {own}; {pair[0]} = {pair[1]}, which is given for all files, counts"
                    doubts.append(Doubt(run.path.name, text, f"--condition 'NAME:{pair[0]}={pair[1]}' for single conditions instead"))
        found.append(replace(run, factors=factors, doubts=tuple(doubts)))
    return found


def with_measured_joined(runs: Sequence[GuessedRun]) -> list[GuessedRun]:
    """Numbers above tables that differ by less than a step become one round number; what a run had itself is its ``actual``."""
    found = list(runs)
    for place, key in enumerate(MEASURED):
        by_unit: dict[str, list[int]] = defaultdict(list)
        for k, run in enumerate(found):
            if key in run.above and key in run.factors:
                by_unit[run.factors[key].value.partition(" ")[2]].append(k)
        for unit, members in by_unit.items():
            numbers = {k: float(found[k].factors[key].value.partition(" ")[0]) for k in members}
            for near_by in chains(numbers, key, unit):
                if len({numbers[k] for k in near_by}) < 2:
                    continue
                # Where numbers drift without a gap, only runs that agree in all else say what belongs together.
                groups = [near_by] if spans_no_step([numbers[k] for k in near_by], key, unit) else agreeing(near_by, found, MEASURED[place:])
                for group in groups:
                    for k, one, low, high in levelled({k: numbers[k] for k in group}, key, unit):
                        found[k] = joined_run(found[k], key, f"{one:.6g} {unit}", f"{low:g}" + (f" to {high:g}" if low < high else "") + f" {unit}")
    return found


def chains(numbers: dict[int, float], key: str, unit: str) -> list[list[int]]:
    """Members whose numbers follow one another in less than a step."""
    found: list[list[int]] = []
    for k in sorted(numbers, key=lambda k: numbers[k]):
        if found and spans_no_step([numbers[found[-1][-1]], numbers[k]], key, unit):
            found[-1].append(k)
        else:
            found.append([k])
    return found


def agreeing(members: Sequence[int], runs: Sequence[GuessedRun], but: Sequence[str]) -> list[list[int]]:
    """Members by what their names and heads say, ``but`` the keys that were measured and are not joined yet."""
    groups: dict[object, list[int]] = defaultdict(list)
    for k in members:
        run = runs[k]
        rest = sorted((key, guess.value) for key, guess in run.factors.items() if key not in but or key not in run.above)
        groups[run.name.label, tuple(rest)].append(k)
    return list(groups.values())


def levelled(numbers: dict[int, float], key: str, unit: str) -> list[tuple[int, float, float, float]]:
    """(member, its level, lowest and highest of the level), parted at the widest gaps until no level spans a step."""
    levels = parted(sorted(set(numbers.values())), key, unit)
    round_ones = [round_number(level, key, unit) for level in levels]
    if len(set(round_ones)) < len(levels):
        round_ones = [sum(level) / len(level) for level in levels]
    return [(k, one, level[0], level[-1]) for one, level in zip(round_ones, levels) for k, number in numbers.items() if number in level]


def parted(numbers: list[float], key: str, unit: str) -> list[list[float]]:
    if spans_no_step(numbers, key, unit):
        return [numbers]
    cut = max(range(1, len(numbers)), key=lambda k: numbers[k] - numbers[k - 1])
    return parted(numbers[:cut], key, unit) + parted(numbers[cut:], key, unit)


def round_number(level: Sequence[float], key: str, unit: str) -> float:
    """The one of fewest digits within half a step of the middle."""
    middle = 0.5 * (level[0] + level[-1])
    half = 0.5 * step_at(middle, key, unit)
    return next((one for digits in range(-6, 6) if abs((one := round(middle, digits)) - middle) <= half), middle)


def joined_run(run: GuessedRun, key: str, one: str, span: str) -> GuessedRun:
    own = run.factors[key]
    least = f"{TEMPERATURE_STEP:g} K" if key == "temperature" else f"{100.0 * SHARE_STEP:g} %"
    why = f"{span} above the tables is one number that was measured: nobody sets less than {least} apart (assumed)"
    text = f"{key} = {span} above the tables is taken for {one}, each run keeping its own: nobody sets less than {least} apart (assumed)"
    doubts = [replace(d, text=d.text.replace(own.value, one), speed=one) if is_of(d, own.value, key) else d for d in run.doubts]
    doubt = Doubt(run.path.name, text, "--names with {condition} in it if these are conditions of their own")
    actual = dict(run.actual) | ({key: own.value} if own.value != one else {})
    return replace(run, factors={**run.factors, key: Guess(one, f"{own.reason}; {why}", False)}, actual=actual, doubts=(*doubts, doubt))


def is_of(doubt: Doubt, speed: str, key: str) -> TypeGuard[SpeedBySize]:
    """Whether this doubts that a speed is one of the shaft of ``key``."""
    return isinstance(doubt, SpeedBySize) and (doubt.speed, doubt.key) == (speed, key)



def near(key: str, own: str, given: str) -> bool:
    """Whether what is given is what was measured, but for its last digits."""
    number, _, unit = own.partition(" ")
    told = given.replace(" ", "").removesuffix(unit.replace(" ", ""))
    try:
        return key in MEASURED and spans_no_step([float(number), float(told.replace(",", "."))], key, unit)
    except ValueError:
        return False
