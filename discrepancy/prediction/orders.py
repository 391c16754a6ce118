"""Names of the orders of the output's turn that a reducer makes."""

from discrepancy.prediction.bench import Bench


def named_orders(bench: Bench) -> dict[str, tuple[float, ...]]:
    """Families of orders per revolution of the output; harmonics of one cause belong together."""
    topology = bench.reducer.topology
    lobes, pins, ratio = topology.lobes, topology.pins, abs(bench.ratio)
    found = {
        "output shaft": (1, 2), "crank, absolute": (lobes,), "crank against carrier": (pins, 2 * pins),
        "ring pins": (2 * lobes, 4 * lobes, 6 * lobes), "pin mesh": (lobes * pins,),
    }  # fmt: skip
    if float(bench.templates[0]["first_stage_ratio"][0]) > 0.0:
        teeth = float(bench.templates[0]["sun_teeth"][0])
        found |= {"sun": (ratio - 1.0, ratio), "first mesh": ((ratio - 1.0) * teeth,)}
    return found
