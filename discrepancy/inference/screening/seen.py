"""What of an effect a campaign can see at all: amplitudes that it cannot are left off, or a fit would send them anywhere."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from discrepancy.inference.base_fit.projection import side_by_side
from discrepancy.inference.screening.screen import LEAST_REACH, Block, Columns, reach
from discrepancy.problem import Candidate
from fmu_src.arrays import Floats


def only_seen(candidates: Sequence[Candidate], columns: Columns, known: Mapping[str, Candidate]) -> tuple[list[Candidate], Columns]:
    """The candidates without amplitudes that stay below the noise even at their bounds (an order that no table has), and their columns.

    What acts one way only may begin beyond a threshold, and stays; so does an effect of which nothing would be left.  Those of ``known``,
    by name, keep what they have: there are fits of them.
    """
    kept = {
        k: [p in known[c.name].amplitudes for p in c.amplitudes] if c.name in known
        else seen_of(c, [columns.values[:, b.columns] for b in columns.blocks if b.candidate == k])
        for k, c in enumerate(candidates)
    }  # fmt: skip
    if all(map(all, kept.values())):
        return list(candidates), columns
    stacks, blocks, width = [], [], 0
    for b in columns.blocks:
        own = columns.values[:, b.columns][:, kept[b.candidate]]
        signs = tuple(sign for sign, seen in zip(b.signs, kept[b.candidate]) if seen)
        stacks.append(own)
        blocks.append(Block(b.candidate, b.shape, slice(width, width + own.shape[1]), signs, b.size))
        width += own.shape[1]
    reduced = [replace(c, amplitudes=tuple(p for p, seen in zip(c.amplitudes, kept[k]) if seen)) for k, c in enumerate(candidates)]
    return reduced, Columns(side_by_side(stacks, len(columns.values)), tuple(blocks))


def seen_of(candidate: Candidate, blocks: Sequence[Floats]) -> list[bool]:
    found = [p.sign != 0 or any(reach(p, block[:, k]) >= LEAST_REACH for block in blocks) for k, p in enumerate(candidate.amplitudes)]
    return found if any(found) else [True] * len(found)
