"""What may be said: the rules from tests and fits to a verdict, and the result as plain data."""

from dataclasses import dataclass, field
from typing import Any

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.screening.visible import Visible

NONE = "none"
ONE = "one effect"
SET = "set"
SEVERAL = "several effects"
INCOMPLETE = "named but incomplete"
UNKNOWN = "unknown"
# What is off is a number of the base model that was not known for sure, or what it computes itself; no effect is missing.
BASE_OFF = "base off"

# Interrupted: what was known by then.
STOPPED = "stopped"


@dataclass(frozen=True)
class Settings:
    """Thresholds.  Levels are for all tests of one kind together: of what is named without more ado (``sure_level``), where unused runs do not
    speak against it (``screen_level``), where they confirm it or a place is beyond doubt (``naming_level``).

    ``second_gain``: what a further effect must gain of the first where nothing else is left to explain; ``needed``: what it must
    gain of that which is left.
    """

    screen_level: float = 0.004
    sure_level: float = 0.001
    localise_level: float = 0.0008
    naming_level: float = 0.02
    leftover_level: float = 0.0015
    second_level: float = 0.001
    captured: float = 0.70
    second_gain: float = 0.10
    needed: float = 0.3
    margin: float = 6.0
    adequate_margin: float = 10.0
    shortlist: int = 7
    most_effects: int = 3
    draws: int = 2000
    coverage: float = 0.95
    seed: int = 0


@dataclass(frozen=True)
class Effect:
    """A named effect with its estimates and what it achieves.

    Of one of several alternatives ``chi2_difference`` is by how much it fits worse than the first, ``reason`` that in words; None and empty of others.
    """

    name: str
    title: str
    part: str
    parameters: dict[str, dict[str, Any]]
    share_explained: float
    gain: float
    held_out_error_before: float
    held_out_error_after: float
    at_bounds: tuple[str, ...]
    p: float
    chi2_difference: float | None = None
    reason: str = ""

    def to_dict(self) -> dict[str, Any]:
        return {**self.__dict__, "at_bounds": list(self.at_bounds)}


@dataclass(frozen=True)
class StandIn:
    """What could stand in place of a named effect, with its estimates; ``reason``: how the fit with it compares to that which is named."""

    name: str
    parameters: dict[str, dict[str, Any]]
    chi2_difference: float
    reason: str


@dataclass(frozen=True)
class BaseError:
    """By how much the base model is off, and where: ``name`` is its number (or error), ``assumed`` what it was held to be, ``within``
    its range or assumed standard deviation; ``explains`` in chi-square."""

    name: str
    title: str
    value: float
    interval: tuple[float, float]
    unit: str
    assumed: float
    within: tuple[float, float]
    explains: float | None

    def to_dict(self) -> dict[str, Any]:
        return {**self.__dict__, "interval": list(self.interval), "within": list(self.within)}


@dataclass(frozen=True)
class Fits:
    """What a diagnosis computed with: the records with their noise, the fits of what is named, and those of its rivals."""

    space: Workspace
    members: list[Refit]
    rivals: list[Refit]


@dataclass(frozen=True)
class Diagnosis:
    """Answer to: which effect does the model lack?

    ``effects`` best first: the one, the members of the set (each an alternative), or all of several.
    ``alternatives`` maps each of several effects to those that could stand in its place, ``stand_ins`` to the same with their estimates.
    ``base_off`` says what of the base model itself is off; ``nuisances`` what was calibrated; ``visible``, where nothing
    is missing, from which size on effects would have been seen; ``fits`` keeps the objects for further use.
    """

    verdict: str
    effects: list[Effect]
    base_off: list[BaseError]
    confusable: list[str]
    alternatives: dict[str, list[str]]
    correlations: dict[str, float]
    rejected: list[dict[str, Any]]
    localisation: dict[str, Any]
    leftover: dict[str, Any]
    captured: float
    p_screen: float
    p_localise: float
    held_out: dict[str, dict[str, Any]]
    nuisances: dict[str, float]
    noise: dict[str, dict[str, Any]]
    warnings: list[str]
    calls: int
    seconds: float
    reason: str
    fits: Fits = field(repr=False)
    visible: list[Visible] = field(default_factory=list)
    stand_ins: dict[str, list[StandIn]] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        plain = {k: v for k, v in self.__dict__.items() if k not in ("fits", "visible")}
        plain["effects"] = [e.to_dict() for e in self.effects]
        plain["base_off"] = [e.to_dict() for e in self.base_off]
        plain["stand_ins"] = {name: [dict(s.__dict__) for s in others] for name, others in self.stand_ins.items()}
        return plain


def decide(significant_candidate: bool, significant_place: bool, named: int, members: int, captured: float, leftover: bool,
           settings: Settings, one_sensor: bool = False, unproved: str = "") -> tuple[str, str]:
    """Verdict and the reason for it; ``named`` effects of the catalogue, none of them if a number of the base model explains the misfit.

    ``one_sensor``: what is named are several errors of one signal's sensor; ``unproved``: what runs that were not fitted say against it.
    """
    if not significant_candidate and not significant_place:
        return NONE, "no effect and no generic function is significant against the noise of the replicates"
    if not significant_candidate:
        return UNKNOWN, "the misfit is significant but no effect of the catalogue explains it"
    if captured < settings.captured:
        return UNKNOWN, f"the best effect captures only {100 * captured:.0f} % of the misfit"
    if named == 0 and (unproved or leftover):
        return UNKNOWN, "a number of the base model is off, and beside it a misfit is left that no effect of the catalogue explains"
    if unproved:
        return INCOMPLETE, unproved
    if leftover:
        return INCOMPLETE, "what is named leaves a significant misfit"
    if named == 0:
        return BASE_OFF, "a number of the base model that is not known for sure explains the misfit: no effect is missing"
    if named > 1 and one_sensor:
        return INCOMPLETE, "it takes several errors of one sensor: look at its calibration, or at a law that the catalogue lacks"
    if named > 1:
        return SEVERAL, "more than one effect is needed, each significant beside the others"
    if members > 1:
        return SET, "these effects fit equally well; this campaign cannot separate them"
    return ONE, "it explains the misfit, and no rival comes near"


class Interrupted(KeyboardInterrupt):
    """Ctrl-C in a diagnosis; ``found`` is what was known by then."""

    def __init__(self, found: Diagnosis):
        super().__init__(found.reason)
        self.found = found
