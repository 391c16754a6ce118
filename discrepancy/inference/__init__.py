"""Statistics of the comparison: knows records and predictions, neither files nor reducers.

In the order in which a diagnosis happens (``diagnose`` walks through it):

1. ``noise``      how much of a difference is noise, from runs that repeat each other; afterwards all is in its units
2. ``base_fit``   the model with its declared nuisances, fitted: what is left over is the misfit
3. ``misfit``     where it fails: signals, orders, places, conditions
4. ``screening``  which candidates would reduce the misfit more than noise does, to first order
5. ``refit``      those few fitted in earnest; ``selection`` chooses which, alone, several, in place of each other
6. ``held_out``   whether it is enough: the error on runs that were never used; ``judgement`` asks it and what a fit leaves
7. ``verdict``    what may be said
8. ``law``        the missing law without a name, where no candidate fits
9. ``next_experiment``  what to measure to tell rivals apart

Each step knows those above it and none below; docs/diagnosis.md says how each decides.
"""
