"""How long a diagnosis still takes in all, told from how long its first steps took: whatever loads the machine, fits are made of the same predictions.

How many fits it takes nobody knows before effects are screened: until then nothing is foretold, for a range that was told rose again and again.  From then on
it is a range, which each step narrows; its end is put off only where a further effect was found, which is said.
It is longest where the base model leaves much:
cages, zeros and lags are looked for beside a large effect again and again; and longer still where several effects are missing, which is said and not counted.
"""

import math

from discrepancy.inference.base_fit.fit import Fit
from fmu_src.progress import between, running, say

# What a diagnosis that is computed from its beginning is called.
WHOLE = "the whole diagnosis"
FITS_FOLLOW = "fits after it take longer, how long is said when effects are screened"
# Root mean square of what the base model leaves, over the noise, from which its effect is large.
LARGE = 3.0
# What follows a step, of the time until effects were screened; beside a large effect or not: as measured on campaigns of 16 files with one large effect
# (1.7 to 12.5, 1.2 to 8.7, up to 5.1 and 0.1 to 0.5; the most of an oval ring) and of the example with 26 small ones (0.6, 0.4 and 0.1).
SCREENED, IN_EARNEST, BESIDE, NAMED = "screened", "in earnest", "beside", "named"
AFTER = {
    SCREENED: {True: (1.3, 13.0), False: (0.1, 2.0)}, IN_EARNEST: {True: (0.7, 9.0), False: (0.1, 1.0)},
    BESIDE: {True: (0.3, 5.5), False: (0.2, 2.0)}, NAMED: {True: (0.05, 0.6), False: (0.05, 0.4)},
}  # fmt: skip
# What is over sooner needs no line of its own [s].
SOON = 20.0


class Outlook:
    """Of one diagnosis; ``unit`` is how long it took until effects were screened [s], 0 before."""

    def __init__(self) -> None:
        self.large, self.unit = False, 0.0

    def fitted(self, base: Fit) -> None:
        """The base model was fitted."""
        self.large = math.sqrt(base.chi2 / max(len(base.residual), 1)) > LARGE
        if whole := running(WHOLE):
            whole.then = FITS_FOLLOW

    def screened(self) -> None:
        """Effects were screened: from here on it can be said."""
        if whole := running(WHOLE):
            self.unit, whole.then = whole.passed, ""
            low, high = self.after(SCREENED)
            if high > SOON:
                say(f"the rest takes {between(low, high)} as this machine is now, longer where several effects are missing")

    def after(self, step: str, more: bool = False) -> tuple[float, float]:
        """The least and the most that the diagnosis takes from this step on [s], which the task of the whole is told; nothing before effects were screened.

        ``more``: there is more to be done than was known before, for another effect was found: an end that was told is put off then alone.
        """
        low, high = (share * self.unit for share in AFTER[step][self.large])
        if self.unit and (whole := running(WHOLE)):
            whole.foretell(low, high, more)
        return low, high

    def found(self, count: int) -> None:
        """A further one is looked for beside so many effects: the first is what was reckoned with, and each that was found is more to be done."""
        _, high = self.after(BESIDE, more=count > 1)
        if count > 1 and high > SOON and running(WHOLE):
            say(f"{count} effects so far, and a further one is looked for: {between(0.0, high)} more")
