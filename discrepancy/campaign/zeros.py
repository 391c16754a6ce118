"""Means that are not used because nobody knows the zero they count from."""

from collections.abc import Iterator, Sequence

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.problem import FREE_ZERO, Record
from fmu_src.units import conversion

# A mean that is a smaller share of its run's standard deviation is as good as taken off (assumed).
SMALL = 0.1


def unused_means(records: Sequence[Record]) -> Iterator[tuple[str, str]]:
    """(what is not used, how to declare it) for each quantity whose runs have a mean and a free zero."""
    for quantity in FREE_ZERO:
        runs = [r.values for r in records if r.quantity == quantity and r.free_zero and len(r.values) > 1]
        means = [float(np.mean(values)) for values in runs]
        if not any(abs(mean) > SMALL * float(np.std(values)) for mean, values in zip(means, runs)):
            continue
        q = QUANTITIES[quantity]
        factor = conversion(q.unit, q.usual_unit)[0]
        low, high = (readable(factor * mean) for mean in (min(means), max(means)))
        span = f"a mean of {low}" if low == high else f"means of {low} to {high}"
        yield (
            f"{quantity}: {span} {q.usual_unit} over a run {'is' if low == high else 'are'} not used, because its zero is free",
            f'if the zero is known (lag under load, wind-up from rest), state zero = "absolute" in [quantities.{quantity}] or in the run',
        )
