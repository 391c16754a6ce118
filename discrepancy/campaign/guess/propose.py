"""A campaign proposed from files: what ``rvwear campaign from`` and a page in the browser show, correct and save."""

import os
import re
import shlex
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatch
from pathlib import Path
from typing import Any
from unicodedata import normalize

from discrepancy.campaign.guess.by_name import given_for_one, spaced
from discrepancy.campaign.guess.conditions import State, named_conditions
from discrepancy.campaign.guess.counted import with_odd_counts_doubted, with_repetitions
from discrepancy.campaign.guess.file_names import stem
from discrepancy.campaign.guess.given_names import require_fit
from discrepancy.campaign.guess.header_units import name_of
from discrepancy.campaign.guess.held_out import held_out
from discrepancy.campaign.guess.in_columns import different_in_columns
from discrepancy.campaign.guess.lacking import lacking
from discrepancy.campaign.guess.measured import with_given_instead, with_measured_joined
from discrepancy.campaign.guess.positions import angle_for, positions_asked
from discrepancy.campaign.guess.run import GuessedRun, guessed_run, is_meant
from discrepancy.campaign.guess.said import Doubt, Guess, SpeedBySize, Unplaced
from discrepancy.campaign.guess.same_number import ANY_REDUCER, figure_of, written_alike
from discrepancy.campaign.guess.same_unit import with_one_unit
from discrepancy.campaign.guess.told_once import merged
from discrepancy.campaign.guess.whose_angle import whose_angle
from discrepancy.campaign.guess.wishes import NAMED, OPEN, SPEEDS, Wishes, of_column
from discrepancy.campaign.measurement_files import measurement_files
from discrepancy.campaign.quantities import FACTOR_KEYS, QUANTITIES, RUNNING, roles_of
from discrepancy.campaign.readers import ENDINGS
from discrepancy.held_names import HELD, LOCKED_AT
from discrepancy.problem import MEAN
from fmu_src.faults import InputFault, nearest
from reducers.library import available, named_in
from reducers.reducer import load_reducer


@dataclass(frozen=True)
class PlacedRun:
    """A run of the campaign; ``where``: its rows, if its file holds several."""

    name: str
    guessed: GuessedRun
    condition: str
    replicate: Guess[int]
    where: dict[str, int]


# How the remedy of a reducer that nobody said begins.
ASKS_REDUCER = "--reducer"


@dataclass(frozen=True)
class Proposal:
    """``data``: folder that all files lie in.  ``joined``: conditions that are like another by what is given -> that one.  ``needs`` must be
    given before a model can be held against the campaign; ``unplaced``: of the doubts those of loops of which nobody says where the input was
    locked; ``angle_of``: whose angle transmission errors stand over, if over one that turns as the output does; ``named``: the reducer of the library
    that lines above the tables name; ``zeros``: quantities of which it is said whether their zero is known."""

    name: str
    reducer: str | None
    data: Path
    conditions: dict[str, dict[str, str]]
    joined: dict[str, str]
    held_out: dict[str, Guess[bool]]
    runs: tuple[PlacedRun, ...]
    doubts: tuple[Doubt, ...]
    needs: tuple[Doubt, ...]
    unplaced: tuple[Unplaced, ...]
    angle_of: Guess[str] | None
    named: str | None
    zeros: dict[str, str]

    def of(self, reducer: str) -> "Proposal":
        """The same of a reducer that is known by now, for which no file has to be read again; InputFault where there is none of that name."""
        load_reducer(reducer)
        return replace(self, reducer=reducer, needs=tuple(need for need in self.needs if not need.remedy.startswith(ASKS_REDUCER)))

    def as_json(self) -> dict[str, Any]:
        return {
            "name": self.name, "reducer": self.reducer, "named": self.named, "data": str(self.data), "conditions": self.conditions, "joined": self.joined,
            "held_out": {name: guess.as_json() for name, guess in self.held_out.items()}, "angle_of": self.angle_of and self.angle_of.as_json(),
            "zeros": self.zeros,
            "runs": [
                {
                    "id": run.name, "file": str(run.guessed.path), "quantity": run.guessed.quantity.as_json(), "condition": run.condition,
                    "replicate": run.replicate.as_json(), "where": run.where, "reading": run.guessed.reading, "names": run.guessed.name.pattern,
                    "columns": {role: entry.as_json() for role, entry in run.guessed.columns.items()},
                    "tags": {tag: guess.as_json() for tag, guess in run.guessed.tags.items()},
                    "stated": {key: guess.as_json() for key, guess in run.guessed.factors.items()}, "actual": dict(run.guessed.actual),
                    "left_out": list(run.guessed.left_out),
                }
                for run in self.runs
            ],
            "doubts": [doubt.as_json() for doubt in self.doubts], "needs": [need.as_json() for need in self.needs],
        }  # fmt: skip


def propose(files: Sequence[Path], wishes: Wishes, name: str = "campaign") -> Proposal:
    """InputFault with file and remedy where one cannot be read, or nothing can be made of it."""
    paths = list(dict.fromkeys(found for path in files for found in (measurement_files(path) if path.is_dir() else (path,))))
    if not paths:
        folders = ", ".join(map(str, files)) or "nothing"
        raise InputFault(f"no files: {folders} holds none of {', '.join(sorted(ENDINGS))}; name measurement files, or folders that hold some")
    if wishes.reducer:
        load_reducer(wishes.reducer)
    measured = with_measured_joined(with_given_instead(with_one_unit([guessed_run(path, wishes) for path in paths]), wishes))
    guessed = with_odd_counts_doubted(with_repetitions(measured, wishes))
    require_fit(paths, wishes.names)
    require_numbers(wishes)
    require_columns(guessed, wishes)
    require_units(guessed, wishes)
    require_roles(guessed, wishes)
    states = written_alike([state_of(run, wishes) for run in guessed])
    by_state = named_conditions(states)
    conditions, labels = dict[str, dict[str, str]](), defaultdict[str, set[str]](set)
    for state in states:
        conditions.setdefault(by_state[state], {})
        conditions[by_state[state]] |= dict(state.stated)
        labels[by_state[state]].add(state.label)
    leave_out_idle(conditions, [(by_state[state], run) for state, run in zip(states, guessed)], wishes)
    joined = given_for_one(conditions, labels, wishes)
    names = [joined.get(by_state[state], by_state[state]) for state in states]
    guessed = [without_what_is_given(run, {by_state[state], name}, wishes) for run, state, name in zip(guessed, states, names)]
    runs = placed(guessed, names)
    angle_of, of_angles = whose_angle(zip(names, guessed), conditions, wishes)
    of_runs = [d for run in guessed for d in (*run.doubts, *said_otherwise(run, wishes))]
    doubts = [*merged([*of_runs, *unfitting(guessed), *of_angles]), *idle_tags(guessed, wishes), *idle_zeros(guessed, wishes)]
    in_conditions = [(run.condition, run.guessed) for run in runs]
    doubts += different_in_columns(in_conditions, conditions)
    unplaced = positions_asked(in_conditions, conditions)
    named = named_in(line for run in guessed for line in run.lines)
    doubts += another_named(named, wishes)
    needs = needs_of(in_conditions, conditions, named, wishes)
    return Proposal(
        name, wishes.reducer, Path(os.path.commonpath([path.resolve().parent for path in paths])), conditions, joined,
        held(wishes, conditions, joined, runs), tuple(runs), (*doubts, *unplaced), needs, tuple(unplaced), angle_of, named,
        {quantity: zero for quantity, zero in wishes.zeros.items() if quantity in {run.quantity.value for run in guessed}},
    )  # fmt: skip


def state_of(run: GuessedRun, wishes: Wishes) -> State:
    """What the file says, and besides what is given for all."""
    said = {key: guess.value for key, guess in run.factors.items()}
    speed_said = any(key.endswith("put_speed") for key in said)
    given = {key: spaced(text) for key, text in wishes.for_all.items() if not (speed_said and key.endswith("put_speed"))}
    if LOCKED_AT in given and (angle := angle_for(run, given.pop(LOCKED_AT))):
        given[LOCKED_AT] = angle
    return State(tuple(sorted((given | said).items())), run.name.label, bool(said or run.name.label), run.quantity.value not in HELD)


def leave_out_idle(conditions: dict[str, dict[str, str]], runs: Sequence[tuple[str, GuessedRun]], wishes: Wishes) -> None:
    """A speed or load that is given for all is no number of a condition in which no file's quantity has one: a loop has no speed.

    ``runs``: condition and run.
    """
    for key in (key for key in wishes.conditions if key in FACTOR_KEYS and FACTOR_KEYS[key].name in RUNNING):
        for name, stated in conditions.items():
            here = [run for condition, run in runs if condition == name]
            if not any(key in run.factors or FACTOR_KEYS[key].name in QUANTITIES[run.quantity.value].factors for run in here):
                stated.pop(key, None)


def require_columns(runs: Sequence[GuessedRun], wishes: Wishes) -> None:
    """InputFault for a unit or a scale of a column that no file has."""
    known = sorted({header for run in runs for header in run.headers})
    given = [*(("--unit", *pair) for pair in wishes.units.items()), *(("--scale", key, f"{factor:g}") for key, factor in wishes.scales.items())]
    for option, key, text in given:
        header = name_of(key.rpartition(":")[2])
        if header not in known:
            raise InputFault(f"{option} {key}={text}: no file has a column {header!r} of numbers; there are {', '.join(known)}{nearest(header, known)}")


def require_units(runs: Sequence[GuessedRun], wishes: Wishes) -> None:
    """InputFault for a unit that is given and that the campaign could not be read with: said here, where it was typed."""
    for run in runs:
        units = wishes.units_for(run.path.name)
        for role, entry in run.columns.items():
            given = of_column(units, entry.header, entry.column.value)
            if given is None:
                continue
            try:
                ANY_REDUCER.conversion(roles_of(QUANTITIES[run.quantity.value])[role], entry.unit.value, f"--unit {entry.header}={given}")
            except InputFault as fault:
                factor = "; a factor is no part of a unit, it is given by --scale" if re.search(r"[*/]\s*[\d.]+|^[\d.]+\s*[*/]", given) else ""
                raise InputFault(f"{fault}{factor}") from None


def require_numbers(wishes: Wishes) -> None:
    """InputFault for a number of a condition that is none, or has a unit of another kind: said here, where it was typed."""
    for given, text in wishes.conditions.items():
        name = given.rpartition(":")[2]
        if name in FACTOR_KEYS and (name, text) != (LOCKED_AT, MEAN) and not (text == NAMED and given in (LOCKED_AT, *SPEEDS)):
            ANY_REDUCER.number(FACTOR_KEYS[name], text, f"--condition {given}")


def require_roles(runs: Sequence[GuessedRun], wishes: Wishes) -> None:
    """InputFault for a ``--column`` that no file follows: a role or a column that there is not, or that its quantity has no place for."""
    known = sorted({role for quantity in QUANTITIES.values() for role in roles_of(quantity)})
    for key, header in wishes.columns.items():
        pattern, colon, role = key.rpartition(":")
        if role not in known:
            raise InputFault(f"--column {key}={header}: there is no such role; choose from {', '.join(known)}{nearest(role, known)}")
        meant = [run for run in runs if not colon or fnmatch(run.path.name, pattern)]
        if not meant:
            raise InputFault(f"--column {key}={header}: no file is named {pattern}; there are {', '.join(run.path.name for run in runs)}")
        headers = sorted({header for run in meant for header in run.headers})
        if name_of(header) not in headers:
            raise InputFault(f"--column {key}={header}: no file has a column {header!r} of numbers; there are {', '.join(headers)}{nearest(header, headers)}")
        if not any(role in run.columns and is_meant(header, run.columns[role].column.value, run.columns[role].header) for run in meant):
            quantities = ", ".join(sorted({run.quantity.value for run in meant}))
            remedy = "say by --quantity what the files hold, or take another role"
            raise InputFault(f"--column {key}={header}: the files are taken for {quantities}, which has no place for this column as {role}; {remedy}")


def said_otherwise(run: GuessedRun, wishes: Wishes) -> list[Doubt]:
    """Conditions that are given for all files, where this one says something else."""
    said = {key: guess.value for key, guess in run.factors.items()}
    return [
        Doubt(run.path.name, f"says {key} = {said[key]}, which is kept, not {text}", f"--condition 'NAME:{key}={text}' for the condition of that name")
        for key, text in wishes.conditions.items() if key in said and text != NAMED and figure_of(key, said[key]) != figure_of(key, text)
    ]


def idle_tags(runs: Sequence[GuessedRun], wishes: Wishes) -> list[Doubt]:
    """Tags that are given and that no file's quantity has."""
    found = []
    for tag, word in wishes.tags.items():
        if not any(tag in run.tags for run in runs):
            having = [q.name for q in QUANTITIES.values() if tag in (*q.tags, *q.optional_tags)]
            found.append(Doubt("campaign", f"--tag {tag}={word} says nothing: no file is taken for {' or '.join(having)}", f"--quantity 'FILES={having[0]}'"))
    return found


def idle_zeros(runs: Sequence[GuessedRun], wishes: Wishes) -> list[Doubt]:
    """Zeros that are said of quantities that no file is taken for."""
    there = {run.quantity.value for run in runs}
    return [
        Doubt("campaign", f"--zero {quantity}={zero} says nothing: no file is taken for {quantity}", f"--quantity 'FILES={quantity}'")
        for quantity, zero in wishes.zeros.items() if quantity not in there
    ]  # fmt: skip


def without_what_is_given(run: GuessedRun, names: set[str], wishes: Wishes) -> GuessedRun:
    """What is given of its condition by one of its ``names`` wins over what the run itself had; whose a speed is that was given is no doubt."""
    given = {key.rpartition(":")[2] for key in wishes.conditions if key.rpartition(":")[0] in names}
    speeds = any(key.endswith("put_speed") for key in given)
    actual = {key: text for key, text in run.actual.items() if key not in given and not (speeds and key.endswith("put_speed"))}
    return replace(run, actual=actual, doubts=tuple(d for d in run.doubts if not (speeds and isinstance(d, SpeedBySize))))


def placed(guessed: Sequence[GuessedRun], conditions: Sequence[str]) -> list[PlacedRun]:
    """Runs with ids of their own, and repetitions counted where names do not say."""
    runs: list[PlacedRun] = []
    taken: set[tuple[object, ...]] = set()
    ids: set[str] = set()
    for run, condition in zip(guessed, conditions):
        for number in run.repeated[1] if run.repeated else (None,):
            same = (run.quantity.value, condition, tuple(sorted((tag, g.value) for tag, g in run.tags.items())))
            wanted = number if number is not None else run.name.replicate
            if wanted is not None and wanted >= 1 and (*same, wanted) not in taken:
                reason = f"column {run.repeated[0]}" if run.repeated else "the file's name"
                replicate = Guess(wanted, reason)
            else:
                free = next(k for k in range(1, len(taken) + 2) if (*same, k) not in taken)
                replicate = Guess(free, "counted in the order of the files", free == 1)
            taken.add((*same, replicate.value))
            plain = re.sub(r"[^\w.-]+", "_", normalize("NFC", stem(run.path))).strip("_.-") or run.quantity.value
            base = plain if number is None else f"{plain}_{number}"
            name = next(n for n in (base, *(f"{base}_{k}" for k in range(2, len(guessed) + 99))) if n not in ids)
            ids.add(name)
            runs.append(PlacedRun(name, run, condition, replicate, {run.repeated[0]: number} if run.repeated and number is not None else {}))
    return runs


def held(wishes: Wishes, conditions: dict[str, dict[str, str]], joined: dict[str, str], runs: Sequence[PlacedRun]) -> dict[str, Guess[bool]]:
    if wishes.held_out is None:
        measured, repeated = defaultdict(list), defaultdict(set)
        for run in runs:
            measured[run.condition].append(run.guessed.quantity.value)
            if run.replicate.value > 1:
                repeated[run.condition].add(run.guessed.quantity.value)
        return held_out(conditions, measured, repeated)
    for name in wishes.held_out:
        if name not in conditions and name not in joined:
            raise InputFault(f"--held-out {name}: there is no such condition; choose from {', '.join(conditions)}")
    return {joined.get(name, name): Guess(True, "given") for name in wishes.held_out}


def unfitting(runs: Sequence[GuessedRun]) -> list[Doubt]:
    """Names that fit none of the given patterns, which others of their quantity do: they are guessed as without; of other kinds no pattern was meant."""
    meant = {run.quantity.value for run in runs if run.name.given}
    return [
        Doubt(run.path.name, f"fits none of the given names and is guessed as {run.name.pattern}",
              f"{shlex.join(['--names', run.name.pattern])} beside the others, corrected")
        for run in runs if not run.name.given and run.quantity.value in meant
    ]  # fmt: skip


def another_named(named: str | None, wishes: Wishes) -> list[Doubt]:
    """A reducer of the library that is not the one whose name stands above the tables; a rigid one of that name is."""
    given = wishes.reducer
    if not named or given not in available() or str(given).startswith(named):
        return []
    return [Doubt("campaign", f"lines above the tables say {named}, not {given}", f"--reducer {named}, if they are right")]


def needs_of(runs: Sequence[tuple[str, GuessedRun]], conditions: dict[str, dict[str, str]], named: str | None, wishes: Wishes) -> tuple[Doubt, ...]:
    """What has to be given before a model can be held against the campaign.  ``runs``: condition and run."""
    found = lacking(runs, conditions)
    if not wishes.reducer:
        text = "which reducer it is has to be said" + (f"; lines above the tables say {named}" if named else "")
        found.append(Doubt("campaign", text, f"{ASKS_REDUCER} {named or OPEN} (rvwear reducer list shows all), or a reducer file"))
    return tuple(found)
