"""Names of the orders of the output's turn that a reducer makes."""

import re
from collections.abc import Mapping

from discrepancy.prediction.bench import Bench

HARMONICS = 3
# Passing rollers, by the race that they pass.
ROLLERS = ("rollers over the crank", "rollers over the disc")
# What a name says of orders that others make, too.
REMARK = re.compile(r" \((order \S+ also [^)]*)\)")


def named_orders(bench: Bench, more: Mapping[str, tuple[float, ...]] | None = None) -> dict[str, tuple[float, ...]]:
    """Families of orders per revolution of the output; harmonics of one cause belong together.

    ``more`` are those that a campaign names, of motor or bench.  What is fixed to the ring is met z_c times a turn
    and cancels at odd multiples between two discs; with one disc nothing cancels, and the ring's marks fall
    on the cranks' orders.
    """
    topology = bench.reducer.topology
    lobes, pins, ratio = topology.lobes, topology.pins, abs(bench.ratio)
    found: dict[str, tuple[float, ...]] = {"output shaft": (1, 2)}
    if topology.discs == 1:
        each = range(1, HARMONICS + 1)
        found |= {
            "crank, absolute, and ring": tuple(lobes * k for k in each),
            "crank against carrier, and ring pins per disc turn": tuple(pins * k for k in each),
        }  # fmt: skip
    else:
        found |= {
            "crank, absolute": (lobes,), "crank against carrier": (pins, 2 * pins),
            "ring pins": (2 * lobes, 4 * lobes, 6 * lobes),
        }  # fmt: skip
    found |= dict(zip(ROLLERS, passing(bench)))
    found["pin mesh"] = (lobes * pins,)
    if bench.starts[0]["first_stage_ratio"] > 0.0:
        teeth = bench.starts[0]["sun_teeth"]
        found |= {sun(ratio - 1.0, pins): (ratio - 1.0, ratio), "first mesh": ((ratio - 1.0) * teeth,)}
    return found | dict(more or {})


def passing(bench: Bench) -> list[tuple[float, ...]]:
    """Orders in which rollers that roll without slip pass a place of the crank's race, and of the disc's, with what a turn of the crank makes of them."""
    topology, inner, outer = bench.reducer.topology, bench.starts[0]["inner_race_radius"], bench.starts[0]["outer_race_radius"]
    shares = (outer / (inner + outer), inner / (inner + outer))
    return [tuple(topology.pins * (topology.rollers * share + k) for k in (-1, 0, 1)) for share in shares]


def sun(against_carrier: float, pins: int) -> str:
    """Its name; a whole first stage puts its turns against the carrier on a harmonic of the cranks', which holes and bearings of a disc make, too."""
    times = against_carrier / pins
    coincides = times > 1.5 and abs(times - round(times)) < 1e-9
    return f"sun (order {against_carrier:.4g} also {round(times)} x crank against carrier)" if coincides else "sun"


def apart_from_remark(name: str) -> tuple[str, str]:
    """A figure's name without what ``sun`` says in it, and that as a line of its own: ``sun: order 120 also 3 x crank against carrier``."""
    remark = REMARK.search(name)
    return (name.replace(remark[0], ""), f"{name[: remark.start()]}: {remark[1]}") if remark else (name, "")
