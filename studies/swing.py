"""The load's swing in lives of bodies in motion.

The load on the reducer's spring is hardly damped (ratio 2e-4: it rings through a hundred crank turns).  Wear that
counts thousands of hours in one meshing cycle leaves lobes, pins and rollers uneven until the cycle is complete, which
no real wear does, strikes the load at every order of the cranks and is worn in by its swing.  A damper of ``RATIO``
takes that away.  Off resonance it changes nothing: forces by the square of its ratio.  Within it of
an order of the cranks a life shows what a speed would do that is not held more closely than that.
"""

import numpy as np
from scipy.linalg import eigh

from fmu_src.arrays import Records
from studies.modes import matrices

# Damping ratio of the swing; below a twentieth accelerated wear and swing drive each other (docs/decisions.md).
RATIO = 0.07


def swing_damping(plant: Records) -> float:
    """The plant's parameter of that name [N.m.s/rad] for a life, from its record in motion."""
    mass, stiffness, _ = matrices(plant.copy())
    load, sun = mass.size - 1, mass.size - 2
    free = [i for i in range(mass.size) if i != sun]
    lowest = eigh(stiffness[np.ix_(free, free)], np.diag(mass[free]), eigvals_only=True, subset_by_index=(0, 0))[0]
    return float(2.0 * RATIO * np.sqrt(max(lowest, 0.0)) * mass[load])
