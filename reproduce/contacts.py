"""All contacts of discs and pins over a crank turn, as rows over the phase on the tooth."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats, Mask
from orchestrator.component import InProcess
from rv_plant.contact import hertz_half_width, hertz_peak_pressure
from studies.pair import Pair
from studies.solve import Turn, record_turn
from wear_fmu.kinematics import equivalent_curvature, flank_arc_per_phase, sliding_per_crank_angle

half_width_of = np.vectorize(hertz_half_width)
pressure_of = np.vectorize(hertz_peak_pressure)
# Phases between which contacts are gathered [deg], folded onto one flank.
EDGES = np.arange(0.0, 181.0, 3.0)
MIDDLES = 0.5 * (EDGES[1:] + EDGES[:-1])


@dataclass(frozen=True)
class Geometry:
    """What the flank's shape depends on; functions of the phase [deg]."""

    lobes: int
    circle: float
    radius: float
    eccentricity: float
    width: float
    modulus: float

    @classmethod
    def of(cls, pair: Pair) -> "Geometry":
        get = pair.plant.number
        return cls(
            pair.reducer.topology.lobes, get("pin_circle_radius"), get("pin_radius"), get("eccentricity"),
            get("mesh_width"), 0.5 * get("elastic_modulus") / (1.0 - get("poisson_ratio") ** 2),
        )  # fmt: skip

    @property
    def k1(self) -> float:
        return self.eccentricity * (self.lobes + 1) / self.circle

    @property
    def inflection(self) -> float:
        """Phase of the inflection [deg]."""
        return math.degrees(math.acos((1.0 + (self.lobes + 1) * self.k1**2) / ((self.lobes + 2) * self.k1)))

    @property
    def steepest(self) -> float:
        """Phase of the largest pressure angle, acos(K1) [deg]."""
        return math.degrees(math.acos(self.k1))

    def curvature(self, phase: npt.ArrayLike) -> Floats:
        """1/rho_eq [1/m]."""
        return rows(equivalent_curvature, phase, self.lobes, self.circle, self.radius, self.k1)

    def sliding(self, phase: npt.ArrayLike) -> Floats:
        """Sliding per crank angle [m/rad]."""
        return rows(sliding_per_crank_angle, phase, self.lobes, self.circle, self.radius, self.k1)

    def travel(self, phase: npt.ArrayLike) -> Floats:
        """What the contact moves along the flank per crank angle in the disc's frame [m/rad]."""
        return rows(flank_arc_per_phase, phase, self.lobes, self.circle, self.radius, self.k1)

    def half_width(self, phase: npt.ArrayLike, force: npt.ArrayLike) -> Floats:
        """Hertz half width [m]."""
        return np.asarray(half_width_of(np.asarray(force, float) / self.width, self.curvature(phase), self.modulus))

    def pressure(self, phase: npt.ArrayLike, force: npt.ArrayLike) -> Floats:
        """Hertz peak pressure [Pa]."""
        return np.asarray(pressure_of(np.asarray(force, float) / self.width, self.curvature(phase), self.modulus))


def rows(kernel: Callable[..., float], phase: npt.ArrayLike, *arguments: float) -> Floats:
    """A kernel over phases in degrees."""
    return np.array([kernel(math.radians(p), *arguments) for p in np.atleast_1d(phase)])


@dataclass(frozen=True)
class Contacts:
    """Contacts at every position of a crank turn: phase [deg, 0 to 180] and force [N], (position, disc, pin)."""

    turn: Turn
    phase: Floats
    force: Floats
    geometry: Geometry

    @property
    def on_loaded_flank(self) -> Mask:
        """The flank with the larger sum of forces."""
        first = self.phase >= 0.0
        return first if self.force[first].sum() >= self.force[~first].sum() else ~first

    @property
    def force_along(self) -> Floats:
        return along_folded(self, self.force)

    @property
    def pressure_along(self) -> Floats:
        """Hertz peak pressure of the mean force [Pa]."""
        return self.geometry.pressure(MIDDLES, self.force_along)

    @property
    def point_sliding_along(self) -> Floats:
        """Sliding length of a material point per pass, 2 a_H v_s/v_c [m]."""
        ratio = self.geometry.sliding(MIDDLES) / self.geometry.travel(MIDDLES)
        return 2.0 * self.geometry.half_width(MIDDLES, self.force_along) * ratio


def along_folded(contacts: Contacts, values: Floats) -> Floats:
    """Mean over the loaded flank by bins of the folded phase."""
    loaded = contacts.on_loaded_flank
    where = np.digitize(np.abs(contacts.phase[loaded]), EDGES) - 1
    where = np.minimum(where, MIDDLES.size - 1)
    count = np.bincount(where, minlength=MIDDLES.size)
    return np.bincount(where, values[loaded], MIDDLES.size) / np.maximum(1, count)


def contacts_of(pair: Pair, positions: int = 72) -> Contacts:
    """One turn at the present wear; the pair's state is put back."""
    saved, before = pair.master.save(), pair.positions
    pair.wear.set("acceleration", 0.0)
    pair.set_positions(positions)
    phases, forces = [], []
    plant = pair.plant
    assert isinstance(plant, InProcess)

    def note() -> None:
        record = plant.records
        phases.append(np.degrees(record["mesh_phase"][0]))
        forces.append(record["mesh_force_now"][0].copy())

    # The profile errors at hand are those for the end of a step of the old length.
    pair.master.step()
    turn = record_turn(pair, positions, note)
    pair.master.restore(saved)
    pair.positions = before
    # Within (-180, 180]: the sign is the flank.
    phase = 180.0 - (180.0 - np.array(phases)) % 360.0
    return Contacts(turn, phase, np.array(forces), Geometry.of(pair))
