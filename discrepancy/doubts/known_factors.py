"""Factors that numbers are off by where they were converted twice, or not at all, and the line of a campaign that takes one out again."""

import json
import math
import shlex
from dataclasses import dataclass

from discrepancy.campaign.model import Source
from fmu_src.units import conversion

# (smaller unit, larger unit) of angles that benches convert between.
ANGLES = (("arcsec", "rad"), ("arcmin", "rad"), ("deg", "rad"), ("arcsec", "deg"), ("arcmin", "deg"), ("arcsec", "arcmin"))
PREFIXES = {1e3: "a prefix, as of mN.m and N.m", 1e6: "two prefixes, as of um and m"}
# Reducers of one type differ from their model by some tens of per cent (assumed): so near is meant.
NEAR = 1.5


@dataclass(frozen=True)
class KnownFactor:
    """``size``: what the numbers are too large by, below 1 where they are too small; ``words``: what it is and what may have been done."""

    size: float
    words: str

    def remedy(self, source: Source, si: str) -> str:
        """With the line that mends it in every run that reads the column.  ``si``: unit of the record that ``source.factor`` leads to."""
        header = source.column.removeprefix("column ")
        if header == source.column:
            return f"{self.words}; divide the numbers by {self.size:.6g} then"
        scale = source.factor / conversion(source.unit, si)[0] / self.size
        entry = f"column = {json.dumps(header, ensure_ascii=False)}, unit = {json.dumps(source.unit, ensure_ascii=False)}, scale = {scale:.6g}"
        again = f"--scale {shlex.quote(f'{header}={scale:.6g}')}"
        return (f"{self.words} Then scale = {scale:.6g} takes it out, with {again} of rvwear campaign from, or of this column in each of its runs in"
                f" campaign.toml: columns.value = {{ {entry} }}")  # fmt: skip


def known_factor(times: float, stated: str, si: str, ratio: float | None) -> KnownFactor | None:
    """The factor that numbers are off by, ``times`` what is expected, in the unit ``stated``; None where it is none of these.

    Of several that are near, those come first that convert into the unit that is stated, for that is done twice, then the nearest.
    """
    found = []
    if si in ("rad", "N.m/rad", "rad/(N.m)"):
        for small, large in ANGLES:
            into = small if times > 1.0 else large
            found.append((stated != into, conversion(large, small)[0], f"{small} in {'an' if large[0] == 'a' else 'a'} {large}: converted twice?"))
    found += [(True, size, f"{words}: converted twice?") for size, words in PREFIXES.items()]
    if ratio and si != "1":
        found.append((True, ratio, "the ratio of the reducer: of the input instead of the output, or the other way round?"))
    away = abs(math.log(times))
    near = [(other, abs(away - math.log(size)), size, words) for other, size, words in found if abs(away - math.log(size)) < math.log(NEAR)]
    if not near:
        return None
    _, _, size, words = min(near)
    return KnownFactor(size if times > 1.0 else 1.0 / size, f"{size:,.{0 if size >= 1000.0 else 1}f}".removesuffix(".0") + f" = {words}")
