"""A step of a model's ladder as what shows it needs it: what was tried, what became of it, errors before and after."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from discrepancy.compare import CONSPICUOUS
from discrepancy.model_file import SignalEntry
from discrepancy.words.sample_errors import furthest_off
from fmu_src.effect_words import effect_title


@dataclass(frozen=True)
class Change:
    """A number over the noise before and after a step."""

    before: float
    after: float


@dataclass(frozen=True)
class Step:
    """``training`` and ``held_out``: misfits in the patterns; None where they were not judged; ``untold``: what of it stays open; ``unseen``: unused
    runs are changed too little to judge it."""

    campaign: str
    effects: tuple[str, ...]
    verdict: str
    reason: str
    kept: bool
    training: Change | None
    held_out: Change | None
    signals: tuple[SignalEntry, ...]
    untold: tuple[str, ...] = ()
    unseen: bool = False

    @property
    def label(self) -> str:
        """``sensor gain (input torque) + drag``"""
        return " + ".join(map(effect_title, self.effects))

    @property
    def left(self) -> dict[str, float]:
        """Signals that the model does not explain after this step, the worst first, by how many times their noise they err."""
        found: dict[str, float] = {}
        for s in self.signals:
            ratio = (s.after if self.kept else s.before) / s.noise_floor if s.noise_floor > 0.0 else 0.0
            if ratio > CONSPICUOUS:
                found[s.signal] = max(ratio, found.get(s.signal, 0.0))
        return dict(sorted(found.items(), key=lambda entry: -entry[1]))

    @property
    def samples(self) -> tuple[str, Change, bool] | None:
        """Of the signal that was furthest off, all samples over the noise, of unused runs where there are such, and whether there are; None of nothing."""
        rows = [s for s in self.signals if s.held_out] or list(self.signals)
        found = furthest_off((s.signal, s.before, s.after, s.noise_floor) for s in rows)
        return None if found is None else (found[0], Change(*found[1:]), rows[0].held_out)

    def change(self, kind: str) -> Change | None:
        """Of the ``training`` or the ``held_out`` runs."""
        return self.held_out if kind == "held_out" else self.training


def steps_of(entries: Sequence[Mapping[str, Any]]) -> list[Step]:
    """The steps as a model file holds them, which were checked when it was read; one written by hand may lack most of it."""
    return [step_of(entry) for entry in entries]


def step_of(entry: Mapping[str, Any]) -> Step:
    def change(kind: str) -> Change | None:
        before, after = entry.get(f"{kind}_before"), entry.get(f"{kind}_after")
        return None if before is None or after is None else Change(float(before), float(after))

    signals = tuple(SignalEntry(**s) for s in entry.get("signals") or [])
    return Step(entry.get("campaign", ""), tuple(entry["effects"]), entry.get("verdict", ""), entry.get("reason", ""), entry.get("kept", True),
                change("training"), change("held_out"), signals, tuple(entry.get("untold") or ()), entry.get("unseen", False))  # fmt: skip
