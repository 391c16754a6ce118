"""Whose angle a transmission error stands over: of an encoder on the output, which lags under load, or the input's over the ratio."""

from collections.abc import Iterable, Mapping

from discrepancy.campaign.guess.column_words import meaning_of, over_ratio, says_output
from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import AngleAssumed, Doubt, Guess
from discrepancy.campaign.guess.wishes import INPUT, OUTPUT, Wishes
from discrepancy.problem import ERROR

# Harmless where it is not so: the share of the lag that is found is none then.
REASON = "an encoder there lags under load; \"input\" if it is the input's over the ratio"
UNEVEN = "its steps are as uneven as the error says that the output turns: of an encoder there, which lags under load"
EVEN = "the input's angle beside it is a multiple of it, with no error between them: it is the input's over the ratio"
TEXT = f'angle_of = "{OUTPUT}" is assumed: of an encoder there, which lags under load; no head says for certain whose the angle is'
IDLE_REMEDY = f"--quantity 'FILES={ERROR}'"
REMEDY = f"--angle-of {INPUT} if it is the input's over the ratio"


def over_output(run: GuessedRun) -> bool:
    """Whether a transmission error stands over an angle that turns as the output does."""
    return run.quantity.value == ERROR and "angle" in run.columns


def beside_input(run: GuessedRun) -> bool:
    """Whether the angle is the output's by its name and the file has the input's beside it, which is not read."""
    return says_output(run.columns["angle"].header) and any(meaning_of(header) == "input_angle" for header in run.headers)


def whose_angle(runs: Iterable[tuple[str, GuessedRun]], conditions: Mapping[str, Mapping[str, str]], wishes: Wishes) -> tuple[Guess[str] | None, list[Doubt]]:
    """One answer for all, None where no run stands over such an angle, and a doubt for each file whose angle may be either's.

    No doubt is left where both encoders are read or named, where its steps tell, or where nothing loads the output: it lags by nothing then.
    ``runs``: condition and run.
    """
    over = [(condition, run) for condition, run in runs if over_output(run)]
    if not over:
        idle = Doubt("campaign", f"--angle-of {wishes.angle_of} says nothing: no file is taken for a {ERROR} over an angle of the output", IDLE_REMEDY)
        return None, [idle] if wishes.angle_of else []
    if wishes.angle_of:
        return Guess(wishes.angle_of, "given"), []
    if all(over_ratio(run.columns["angle"].header) for _, run in over):
        return Guess(INPUT, "its name says the input's over the ratio"), []
    loaded = [run for condition, run in over if conditions[condition].get("load_torque", "").split(" ")[0] != "0"]
    steps = {run.of_output for _, run in over}
    if len(steps) == 1 and None not in steps:
        return Guess(OUTPUT, UNEVEN) if True in steps else Guess(INPUT, EVEN), []
    either = [run for run in loaded if "input_angle" not in run.columns and not beside_input(run) and run.of_output is None]
    return Guess(OUTPUT, REASON, not either), [AngleAssumed(run.path.name, TEXT, REMEDY, so=f"--angle-of {OUTPUT}") for run in either]
