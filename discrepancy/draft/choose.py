"""Which recovered law is drafted: alone, in place of what comes near, or beside what the diagnosis names."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from discrepancy.draft.expression import Expression, expression_of
from discrepancy.draft.places import Drive, NoPlace, Place, place_of
from discrepancy.draft.write import equation, over, text_of
from discrepancy.inference.law.closed_forms import closed_forms
from discrepancy.inference.law.recover import Recovered, recover
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.verdict import INCOMPLETE, UNKNOWN
from discrepancy.model_file import every_effect
from discrepancy.verdict import Answer, told_in
from fmu_src.checked_file import write_text
from fmu_src.effect_check import WHERE, check_any_file
from fmu_src.faults import InputFault
from fmu_src.source_hash import USER_EFFECTS


@dataclass(frozen=True)
class Draft:
    """An effect's file that is not written yet; ``beside`` are the candidates that it stands beside."""

    name: str
    file: Path
    text: str
    law: Recovered
    place: Place
    expression: Expression
    beside: tuple[str, ...] = ()

    @property
    def equation(self) -> str:
        return equation(self.place, self.expression)

    def as_json(self) -> dict[str, Any]:
        return {
            "effect": self.name, "file": str(self.file), "unit": self.place.package, "hook": self.place.hook.partition("(")[0],
            "equation": self.equation, "over": over(self.place, self.expression), "law": self.law.text, "beside": list(self.beside),
        }  # fmt: skip


def require_folder(folder: Path) -> None:
    """InputFault where effects of one's own lie in another folder than the draft's: there can be but one."""
    known = os.environ.get(USER_EFFECTS)
    if known and Path(known).resolve() != folder.resolve():
        raise InputFault(
            f"--draft {folder}: {USER_EFFECTS} names {known}, and units take effects from one folder; give --draft {known}, or unset {USER_EFFECTS}"
        )
    if folder.exists() and not folder.is_dir():
        raise InputFault(f"--draft {folder} is a file; give the folder in which effects lie in {WHERE}")


def drafts_of(answer: Answer, folder: Path, name: str | None = None) -> tuple[list[Draft], list[str]]:
    """(drafts, why other laws have none): the law of the whole misfit, and beside what is named the law of what that leaves."""
    if answer.verdict not in (UNKNOWN, INCOMPLETE):
        return [], []
    found = answer.diagnosis.fits
    touched = sorted({finding["signal"] for finding in answer.diagnosis.localisation["findings"]}) or None
    drafts, reasons = [], []
    alone, why = best_of(recover(found.space, found.space.base, touched, told_in(answer.model)), answer, folder, name)
    reasons += why
    if alone is not None:
        drafts.append(alone)
    if answer.verdict == INCOMPLETE and answer.laws:
        names = tuple(c.name for c in found.members[0].candidates)
        beside, why = best_of(answer.laws, answer, folder, f"{name}_beside" if name else None, names)
        reasons += [f"beside {', '.join(names)}: {text}" for text in why]
        if beside is not None:
            drafts.append(beside)
    return drafts, list(dict.fromkeys(reasons))


def best_of(laws: list[Recovered], answer: Answer, folder: Path, name: str | None, beside: tuple[str, ...] = ()) -> tuple[Draft | None, list[str]]:
    """The law that takes most of the misfit among those that have a place."""
    bench, reasons = answer.model.bench, []
    drive = Drive(bench.ratio, bench.reducer.topology.lobes)
    for law in sorted(laws, key=taken, reverse=True):
        if not law.forms:
            reasons.append(law.text)
            continue
        zero_known = not any(r.free_zero for r in answer.model.records if stream_of(r) == law.signal)
        try:
            place = place_of(law, drive, zero_known)
        except NoPlace as reason:
            reasons.append(f"{law.signal} over {law.leading}: {reason}")
            continue
        called = name or f"{law.signal.partition('[')[0]}_over_{law.leading}{'_beside' if beside else ''}"
        expression = expression_of(law, place.level)
        text = text_of(called, law, place, expression, answer.model.campaign.name, answer.model.file.name)
        return Draft(called, folder / place.package / f"{called}.py", text, law, place, expression, beside), reasons
    return None, reasons


def taken(law: Recovered) -> float:
    """What the best form takes of the misfit, in chi-square."""
    if not law.forms:
        return 0.0
    form, (factor, offset, _) = law.forms[0], law.x_told
    x, y, deviation = (np.asarray(law.points[k], float) for k in ("x", "y", "deviation"))
    told = factor * x + offset
    fitted = closed_forms(told)[form.name][2](told, *form.parameters.values()) / law.y_told[0]
    return float(np.sum((y / deviation) ** 2) - np.sum(((y - fitted) / deviation) ** 2))


def write(draft: Draft) -> None:
    """Write the file and look at it as the unit will; InputFault where it cannot be, and then nothing is left."""
    there = draft.file.exists()
    if there and draft.file.read_text(encoding="utf-8") != draft.text:
        raise InputFault(f"{draft.file}: is there already and says something else; give the draft another name (--name NAME) or take that file away")
    if not there and draft.name in every_effect():
        raise InputFault(f"--name {draft.name}: there is an effect of this name already; give the draft another one")
    write_text(draft.file, draft.text)
    findings = check_any_file(draft.file)
    if findings:
        if not there:
            draft.file.unlink()
        raise InputFault("\n".join(map(str, findings)))


def written_to(answer: Answer, file: Path) -> Path | None:
    """The draft of the whole misfit's law in a file of any name and place; None where there is none."""
    drafts, _ = drafts_of(answer, file.parent, file.stem)
    if not drafts:
        return None
    write_text(file, drafts[0].text)
    return file
