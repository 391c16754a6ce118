"""What is stated of single conditions by their names, ``NAME:KEY=VALUE``; conditions that are alike by it become one."""

import re
from collections.abc import Mapping

from discrepancy.campaign.guess.same_number import in_figures
from discrepancy.campaign.guess.wishes import Wishes
from fmu_src.faults import InputFault, nearest

NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S.*)")


def given_for_one(conditions: dict[str, dict[str, str]], labels: Mapping[str, set[str]], wishes: Wishes) -> dict[str, str]:
    """Lays ``NAME:KEY`` over the condition of that name; InputFault if there is none.

    Those that say the same when all is laid, and have the same words (``labels``), become the first of them: name -> that one's name.  Not
    before: 25 and 28 degC that are to be 28 and 31 are alike in between.
    """
    for key, text in wishes.conditions.items():
        name, colon, own = key.rpartition(":")
        if not colon:
            continue
        if name not in conditions:
            raise InputFault(f"--condition {key}={text}: there is no condition {name}; choose from {', '.join(conditions)}{nearest(name, conditions)}")
        if own.endswith("put_speed"):
            conditions[name] = {k: v for k, v in conditions[name].items() if not k.endswith("put_speed")}
        conditions[name][own] = spaced(text)
    stated = {key.rpartition(":")[0] for key in wishes.conditions}
    joined: dict[str, str] = {}
    for name in list(conditions):
        alike = [n for n in conditions if labels[n] == labels[name] and in_figures(conditions[n]) == in_figures(conditions[name])]
        if alike[0] != name and stated & {name, alike[0]}:
            joined[name] = alike[0]
            del conditions[name]
    return joined


def spaced(text: str) -> str:
    """25degC as files say it: 25 degC."""
    match = NUMBER_AND_UNIT.fullmatch(text)
    return f"{match[1]} {match[2].strip()}" if match else text
