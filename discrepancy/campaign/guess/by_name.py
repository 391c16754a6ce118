"""What is stated of single conditions by their names, ``NAME:KEY=VALUE``; conditions that are alike by it become one."""

import re
from collections.abc import Mapping

from discrepancy.campaign.guess.wishes import Wishes
from fmu_src.faults import InputFault, nearest

NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S.*)")


def given_for_one(conditions: dict[str, dict[str, str]], labels: Mapping[str, set[str]], wishes: Wishes) -> dict[str, str]:
    """Lays ``NAME:KEY`` over the condition of that name; InputFault if there is none.

    One that then says the same as another of the same words (``labels``) joins it: name -> name of the one that it joined, whose what is said
    of it later is, too.
    """
    joined: dict[str, str] = {}
    for key, text in wishes.conditions.items():
        name, colon, own = key.rpartition(":")
        if not colon:
            continue
        if name not in conditions and name not in joined:
            raise InputFault(f"--condition {key}={text}: there is no condition {name}; choose from {', '.join(conditions)}{nearest(name, conditions)}")
        name = joined.get(name, name)
        if own.endswith("put_speed"):
            conditions[name] = {k: v for k, v in conditions[name].items() if not k.endswith("put_speed")}
        conditions[name][own] = spaced(text)
        alike = [n for n in conditions if labels[n] == labels[name] and in_figures(conditions[n]) == in_figures(conditions[name])]
        for other in alike[1:]:
            joined |= {n: alike[0] for n, into in joined.items() if into == other} | {other: alike[0]}
            del conditions[other]
    return joined


def spaced(text: str) -> str:
    """25degC as files say it: 25 degC."""
    match = NUMBER_AND_UNIT.fullmatch(text)
    return f"{match[1]} {match[2].strip()}" if match else text


def in_figures(stated: Mapping[str, str]) -> dict[str, object]:
    """To be compared however it was written: 25 degC, 25.0 degC."""
    matches = {key: NUMBER_AND_UNIT.fullmatch(text) for key, text in stated.items()}
    return {key: (float(match[1]), match[2].strip()) if (match := matches[key]) else text for key, text in stated.items()}
