"""``rvwear modes`` against a linearisation of its own: energies of all contacts and springs in plain NumPy, differences of second order.

Nothing of ``rv_plant`` is used but the places at which the plant stands: contacts by closest points of the trochoid, approach of rollers, teeth and
supports are written anew from the definitions in docs/physics.md.
"""

import numpy as np
import pytest
from scipy.linalg import eigh

from orchestrator.settings import parse_setting
from reducers.reducer import load_reducer
from studies.modes import at_rated_motion, modes

STEP = 2e-8
N = 10.0 / 9.0


class Energy:
    """Potential energy [J] of discs, cranks, carrier, ring, sun and load at places q."""

    def __init__(self, reducer, record):
        s = {name: float(np.ravel(record[name])[0]) for name in (
            "eccentricity", "pin_circle_radius", "pin_radius", "crank_circle_radius", "bearing_clearance", "mesh_stiffness", "roller_stiffness",
            "first_stage_ratio", "crank_seat_compliance", "carrier_seat_compliance", "carrier_twist_compliance", "ring_seat_compliance", "tooth_compliance",
            "tooth_backlash", "tooth_stiffness_variation", "sun_teeth", "pressure_angle", "cage",
        )}  # fmt: skip
        self.s, self.t = s, reducer.topology
        self.place = 2.0 * np.pi * np.arange(self.t.cranks) / self.t.cranks
        self.half_turn = 2.0 * np.pi * np.arange(self.t.discs) / self.t.discs

    def flanks(self, centre, turning, offset, ring):
        """Approach of all pins to a disc: depth of the pins' centres inside the curve on which ideal ones lie."""
        s, pins = self.s, self.t.pins
        pin = s["pin_circle_radius"] * np.exp(1j * (2.0 * np.pi * np.arange(pins) / pins + ring))
        seen = (pin - centre) * np.exp(-1j * turning)

        def curve(t):
            large, small = s["pin_circle_radius"] * np.exp(1j * t), s["eccentricity"] * np.exp(1j * (pins * t + offset))
            return large - small, 1j * (large - pins * small), -(large - pins**2 * small)

        # The nearest of some points of half a lobe to either side, then Newton.
        near = np.angle(seen)[:, None] + np.linspace(-0.5, 0.5, 41) * 2.0 * np.pi / pins
        t = near[np.arange(pins), abs(curve(near)[0] - seen[:, None]).argmin(axis=1)]
        for _ in range(8):
            point, along, bend = curve(t)
            off = seen - point
            t = t - (off.conj() * along).real / ((off.conj() * bend).real - abs(along) ** 2)
        point, along, _ = curve(t)
        outward = -1j * along / abs(along)
        return -((seen - point) * outward.conj()).real

    def __call__(self, q):
        s, t = self.s, self.t
        carrier = 3 * t.discs
        ring, sun, load = carrier + 3 + 3 * t.cranks, carrier + 4 + 3 * t.cranks, carrier + 5 + 3 * t.cranks
        per_metre = 1e3**N / (N + 1.0)
        total = 0.0
        seats = s["crank_circle_radius"] * np.exp(1j * (q[carrier] + self.place))
        crank = np.array([q[carrier + 3 + 3 * c] + 1j * q[carrier + 4 + 3 * c] for c in range(t.cranks)])
        for d in range(t.discs):
            centre, turning = q[3 * d] + 1j * q[3 * d + 1], q[3 * d + 2]
            deep = np.maximum(self.flanks(centre, turning, self.half_turn[d], q[ring]), 0.0)
            total += s["mesh_stiffness"] * per_metre * np.sum(deep ** (N + 1.0))
            holes = centre + s["crank_circle_radius"] * np.exp(1j * (turning + self.place))
            for c in range(t.cranks):
                lobe = crank[c] + s["eccentricity"] * np.exp(1j * (q[carrier + 5 + 3 * c] + self.half_turn[d]))
                ways = np.exp(1j * (turning + self.place[c] + s["cage"] + 2.0 * np.pi * np.arange(t.rollers) / t.rollers))
                squeezed = np.maximum(((lobe - holes[c]) * ways.conj()).real - s["bearing_clearance"], 0.0)
                total += s["roller_stiffness"] * per_metre * np.sum(squeezed ** (N + 1.0))
        middle = q[carrier + 1] + 1j * q[carrier + 2]
        total += np.sum(abs(crank - middle - seats) ** 2) / (2.0 * s["crank_seat_compliance"]) + abs(middle) ** 2 / (2.0 * s["carrier_seat_compliance"])
        total += q[ring] ** 2 / (2.0 * s["ring_seat_compliance"]) + (q[carrier] - q[load]) ** 2 / (2.0 * s["carrier_twist_compliance"])
        planet = s["crank_circle_radius"] * s["first_stage_ratio"] / (1.0 + s["first_stage_ratio"])
        small, stage = s["crank_circle_radius"] - planet, s["pressure_angle"]
        stiff = (1.0 + s["tooth_stiffness_variation"] * np.cos(s["sun_teeth"] * (q[sun] - q[carrier]))) / s["tooth_compliance"]
        for c in range(t.cranks):
            round_sun = self.place[c] + q[carrier] + np.angle(crank[c] * np.exp(-1j * (self.place[c] + q[carrier])))
            seen = round_sun - self.place[c]
            rolled = small * (q[sun] - seen) + planet * (q[carrier + 5 + 3 * c] - seen)
            for side in (1.0, -1.0):
                approach = side * rolled * np.cos(stage) - (abs(crank[c]) - s["crank_circle_radius"]) * np.sin(stage) - 0.5 * s["tooth_backlash"]
                total += 0.5 * stiff * max(approach, 0.0) ** 2
        return total


def frequencies(energy, places, mass, free):
    """Natural frequencies [Hz] from differences of the energy; angles move the pins as far as STEP."""
    size = np.array([STEP if free_is_length else STEP / 0.03 for free_is_length in lengths(energy.t)])

    def at(**moved):
        q = places.copy()
        for i, way in moved.items():
            q[int(i[1:])] += way * size[int(i[1:])]
        return energy(q)

    n, centre = len(free), at()
    stiffness = np.zeros((n, n))
    one = {(i, way): at(**{f"q{i}": way}) for i in free for way in (1.0, -1.0)}
    for a, i in enumerate(free):
        stiffness[a, a] = (one[i, 1.0] - 2.0 * centre + one[i, -1.0]) / size[i] ** 2
        for b, k in enumerate(free[:a]):
            both = at(**{f"q{i}": 1.0, f"q{k}": 1.0}) + at(**{f"q{i}": -1.0, f"q{k}": -1.0})
            mixed = both - one[i, 1.0] - one[i, -1.0] - one[k, 1.0] - one[k, -1.0] + 2.0 * centre
            stiffness[a, b] = stiffness[b, a] = mixed / (2.0 * size[i] * size[k])
    return np.sqrt(np.maximum(eigh(stiffness, np.diag(mass[free]), eigvals_only=True), 0.0)) / (2.0 * np.pi)


def lengths(t):
    return [True, True, False] * t.discs + [False, True, True] + [True, True, False] * t.cranks + [False, False, False]


@pytest.mark.parametrize(("name", "share", "held"), [("RV20E-121", 1.0, True), ("RV20E-121", 0.3, False), ("BX-40E", 1.0, False)])
def test_natural_frequencies_are_those_of_energies_written_anew(name, share, held):
    reducer = load_reducer(name)
    load = parse_setting(f"output.load_torque={share * reducer.starts['load_torque']}", [reducer.plant])
    found = np.array([mode.frequency_Hz for mode in modes(reducer, [load], held)])
    record = at_rated_motion(reducer, [load]).record()
    places, mass = np.ravel(record["q"]).copy(), np.ravel(record["mass"]).copy()
    free = [i for i in range(len(places)) if not (held and i == len(places) - 2)]
    anew = frequencies(Energy(reducer, record), places, mass, free)
    anew = anew[anew < 5e4]
    assert len(anew) == len(found)
    held_by_something = found > 15.0
    assert anew[held_by_something] == pytest.approx(found[held_by_something], rel=3e-3)
    assert np.all(anew[~held_by_something] < 15.0) and held_by_something.sum() >= 17
