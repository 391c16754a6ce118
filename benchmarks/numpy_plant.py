"""The reducer in whole-array NumPy, as a careful user would write it: what the kernels are measured against.

Points of the plane are complex numbers.  Ideal parts, line contact, damping of the law
"step", compliant joints, one unworn reducer: the case of the benchmarks and no more.
``benchmarks.run`` checks that its right-hand sides are those of the kernels.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats

# Points and directions of the plane.
Complex = npt.NDArray[np.complex128]

RIGID, RIGID_TOOTH = 1e-12, 1e-10


def cross(a: Complex, b: Complex) -> Floats:
    return (np.conj(a) * b).imag


class NumpyPlant:
    """Right-hand sides of one plant record."""

    def __init__(self, record: np.void):
        # Numbers and arrays by their names.
        self.r: dict[str, Any] = {name: record[name].copy() if np.ndim(record[name]) else record[name].item() for name in record.dtype.names or ()}
        r = self.r
        self.discs, self.pins = r["mesh_force"].shape
        self.cranks, self.rollers = r["roller_force"].shape[1:]
        self.lobes = self.pins - 1
        self.circle, self.radius, self.throw = r["pin_circle_radius"], r["pin_radius"], r["eccentricity"]
        self.carrier, self.ring = 3 * self.discs, 3 * self.discs + 3 + 3 * self.cranks
        self.pin_angle = 2.0 * np.pi * np.arange(self.pins) / self.pins
        self.pin = self.circle * np.exp(1j * self.pin_angle)
        self.offset = 2.0 * np.pi * np.arange(self.discs) / self.discs
        self.arms = np.exp(2j * np.pi * np.arange(self.cranks) / self.cranks)
        self.roller = np.exp(2j * np.pi * np.arange(self.rollers) / self.rollers)
        self.planet = r["crank_circle_radius"] * r["first_stage_ratio"] / (1.0 + r["first_stage_ratio"])

    def closest(self, centre: Complex, phi: Floats) -> tuple[Floats, Complex]:
        """Signed distance of pin centres to the centre curve, and its outward normal."""
        lobes, throw = self.lobes, self.throw
        for _ in range(20):
            slow, fast = np.exp(1j * phi / lobes), np.exp(1j * phi * (lobes + 1) / lobes)
            away = centre - (self.circle * slow - throw * fast)
            first = 1j / lobes * self.circle * slow - 1j * (lobes + 1) / lobes * throw * fast
            second = -self.circle / lobes**2 * slow + ((lobes + 1) / lobes) ** 2 * throw * fast
            turn = (away * first.conj()).real / (abs(first) ** 2 - (away * second.conj()).real)
            if abs(turn).max() < 1e-10:
                break
            phi = phi + turn
        normal = -1j * first / abs(first)
        return (away * normal.conj()).real, normal

    def mesh(
        self, ideal: float, disc_centre: Complex, disc_turn: Floats, ring_turn: float
    ) -> tuple[Floats, Complex, Complex, Complex]:
        """Penetrations [disc, pin], normals, and arms about disc and ring."""
        along = (self.lobes * (self.pin_angle - ideal) + self.offset[:, None]) / (2.0 * np.pi)
        root = np.round(along)
        frame = np.exp(1j * (disc_turn[:, None] - self.offset[:, None] / self.lobes + 2.0 * np.pi * root / self.lobes))
        pin = self.pin * np.exp(1j * ring_turn)
        arm = pin - disc_centre[:, None]
        distance, normal = self.closest(arm / frame, 2.0 * np.pi * (along - root))
        return -distance, normal * frame, arm, pin

    def force(self, depth: Floats, rate: Floats | None, constant: float, exponent: float, damping: float) -> Floats:
        """Elastic force with step damping; never pulls."""
        pressed = np.maximum(depth, 0.0)
        elastic = constant * pressed**exponent
        if rate is None:
            return elastic
        share = np.minimum(1.0, pressed / self.r["damping_depth"])
        found: Floats = np.maximum(elastic + damping * share * share * (3.0 - 2.0 * share) * rate, 0.0)
        return found

    def bearing(
        self, lobe: Complex, hole_direction: Complex, cage: float, disc_centre: Complex
    ) -> tuple[Floats, Complex, Floats, Complex]:
        """Approaches [disc, crank, roller], their directions, twists, and holes from the discs' centres."""
        hole = self.r["crank_circle_radius"] * hole_direction
        direction = hole_direction[..., None] * np.exp(1j * cage) * self.roller
        shift = lobe - hole - disc_centre[:, None]
        turned = shift[..., None] * direction.conj()
        return turned.real - self.r["bearing_clearance"], direction, turned.imag, hole

    def out_of_balance(self, z: Floats, ideal: float, cage: float) -> Floats:
        """Residual of the equilibrium for the free coordinates: discs and carrier turning."""
        r = self.r
        eccentric = np.exp(1j * (self.offset - self.lobes * ideal))
        of_disc = z.reshape(-1)[: self.carrier].reshape(self.discs, 3)
        centre = (self.throw + of_disc[:, 0] + 1j * of_disc[:, 1]) * eccentric
        disc_turn, carrier = ideal + of_disc[:, 2], z[self.carrier]
        depth, normal, arm, _ = self.mesh(ideal, centre, disc_turn, 0.0)
        push = self.force(depth, None, r["mesh_constant"], r["mesh_exponent"], 0.0) * normal
        per_turn = 1.0 + 1.0 / r["first_stage_ratio"] if r["first_stage_ratio"] > 0.0 else 0.0
        throw = self.throw * np.exp(1j * (-self.lobes * ideal + per_turn * carrier + self.offset))[:, None]
        seat = r["crank_circle_radius"] * self.arms * np.exp(1j * (ideal + carrier))
        hole_direction = self.arms * np.exp(1j * disc_turn)[:, None]
        approach, direction, twist, hole = self.bearing(seat + throw, hole_direction, cage, centre)
        f = self.force(approach, None, r["roller_constant"], r["roller_exponent"], 0.0)
        pull = (f * direction).sum(axis=2)
        on_disc = (push.sum(axis=1) - pull.sum(axis=1)) * eccentric.conj()
        moment = cross(arm, push).sum(axis=1) - (cross(hole, pull) - (f * twist).sum(axis=2)).sum(axis=1)
        out = np.empty(self.carrier + 1)
        out[: self.carrier] = np.stack([on_disc.real, on_disc.imag, moment], axis=1).ravel()
        out[self.carrier] = cross(seat + per_turn * throw, pull).sum() + r["load_torque"]
        return out

    def forces(self, z: Floats, ideal: float, cage: float) -> Floats:
        """Contact forces of an equilibrium, for its accuracy."""
        r = self.r
        eccentric = np.exp(1j * (self.offset - self.lobes * ideal))
        of_disc = z[: self.carrier].reshape(self.discs, 3)
        centre = (self.throw + of_disc[:, 0] + 1j * of_disc[:, 1]) * eccentric
        depth, *_ = self.mesh(ideal, centre, ideal + of_disc[:, 2], 0.0)
        return self.force(depth, None, r["mesh_constant"], r["mesh_exponent"], 0.0)

    def rate_of_change(self, y: Floats) -> Floats:
        """dy/dt of y = (places, velocities, cage angle) of all bodies, sun and load."""
        r, n, carrier, ring = self.r, self.ring + 3, self.carrier, self.ring
        q, v, cage = y[:n], y[n : 2 * n], y[2 * n]
        sun, load = ring + 1, ring + 2
        discs, disc_rates = q[:carrier].reshape(-1, 3), v[:carrier].reshape(-1, 3)
        cranks, crank_rates = q[carrier + 3 : ring].reshape(-1, 3), v[carrier + 3 : ring].reshape(-1, 3)
        centre, centre_rate = discs[:, 0] + 1j * discs[:, 1], disc_rates[:, 0] + 1j * disc_rates[:, 1]
        crank, crank_rate = cranks[:, 0] + 1j * cranks[:, 1], crank_rates[:, 0] + 1j * crank_rates[:, 1]
        turn, turn_rate = discs[:, 2], disc_rates[:, 2]
        ideal = q[carrier] - 2.0 * np.pi * np.floor(q[carrier] / (2.0 * np.pi) + 0.5)
        share = r["inner_race_radius"] / (r["inner_race_radius"] + r["outer_race_radius"])
        cage_speed = (v[carrier + 5] - v[carrier]) * share
        out = np.zeros(n)

        depth, normal, arm, pin = self.mesh(ideal, centre, turn, q[ring])
        about_disc, about_ring = cross(arm, normal), -cross(pin, normal)
        rate = (centre_rate[:, None] * normal.conj()).real + about_disc * turn_rate[:, None] + about_ring * v[ring]
        push = self.force(depth, rate, r["mesh_constant"], r["mesh_exponent"], r["mesh_damping"])
        on_disc = (push * normal).sum(axis=1)
        out[2:carrier:3] = (push * about_disc).sum(axis=1)
        out[ring] = (push * about_ring).sum()

        throw = self.throw * np.exp(1j * (cranks[:, 2] + self.offset[:, None]))
        hole_direction = self.arms * np.exp(1j * turn)[:, None]
        approach, direction, twist, hole = self.bearing(crank + throw, hole_direction, cage, centre)
        shift_rate = crank_rate + 1j * crank_rates[:, 2] * throw - (centre_rate + 0j)[:, None] - 1j * turn_rate[:, None] * hole
        rate = (shift_rate[..., None] * direction.conj()).real + twist * (turn_rate + cage_speed)[:, None, None]
        f = self.force(approach, rate, r["roller_constant"], r["roller_exponent"], r["roller_damping"])
        pull = (f * direction).sum(axis=2)
        on_disc = on_disc - pull.sum(axis=1)
        out[0:carrier:3], out[1:carrier:3] = on_disc.real, on_disc.imag
        out[2:carrier:3] += ((f * twist).sum(axis=2) - cross(hole, pull)).sum(axis=1)
        on_crank = pull.sum(axis=0)
        out[carrier + 5 : ring : 3] = cross(throw, pull).sum(axis=0)

        delay = r["joint_damping_time"]
        seat = r["crank_circle_radius"] * self.arms * np.exp(1j * q[carrier])
        body, body_rate = q[carrier + 1] + 1j * q[carrier + 2], v[carrier + 1] + 1j * v[carrier + 2]
        stretch, stretch_rate = crank - body - seat, crank_rate - body_rate - 1j * v[carrier] * seat
        support = (stretch + delay * stretch_rate) / max(r["crank_seat_compliance"] + r["crank_support_compliance"], RIGID)
        main = (body + delay * body_rate) / max(r["carrier_seat_compliance"] + r["main_bearing_compliance"], RIGID) - support.sum()
        on_crank = on_crank + support
        out[carrier] -= cross(seat, support).sum()
        out[ring] += (q[ring] + delay * v[ring]) / max(r["ring_seat_compliance"] + r["housing_compliance"], RIGID)
        shaft = (q[carrier] - q[load] + delay * (v[carrier] - v[load])) / max(r["carrier_twist_compliance"] + r["carrier_compliance"], RIGID)
        out[carrier] += shaft
        out[load] += r["load_torque"] - shaft
        out[sun] -= r["input_torque"]
        if r["first_stage_ratio"] > 0.0:
            on_crank = on_crank + self.teeth(out, q, v, crank, crank_rate, cranks, crank_rates)
        else:
            driving = (cranks[:, 2] - q[sun] + delay * (crank_rates[:, 2] - v[sun])) / RIGID
            out[carrier + 5 : ring : 3] += driving
            out[sun] -= driving.sum()
        out[carrier + 1], out[carrier + 2] = main.real, main.imag
        out[carrier + 3 : ring : 3], out[carrier + 4 : ring : 3] = on_crank.real, on_crank.imag
        return np.concatenate([v, -out / r["mass"], [cage_speed]])

    def teeth(
        self, out: Floats, q: Floats, v: Floats, crank: Complex, crank_rate: Complex, cranks: Floats, crank_rates: Floats
    ) -> Complex:
        """Sun and planets, both flanks; adds to sun and cranks' turning, returns the force on the cranks' centres."""
        r, carrier, sun = self.r, self.carrier, self.ring + 1
        small = self.planet / r["first_stage_ratio"]
        distance = abs(crank)
        turned = q[carrier] + np.angle(crank / (self.arms * np.exp(1j * q[carrier])))
        rolled = small * (q[sun] - turned) + self.planet * (cranks[:, 2] - turned)
        ca, sa = np.cos(r["pressure_angle"]), np.sin(r["pressure_angle"])
        stiffness = 1.0 / max(r["tooth_compliance"] + r["first_stage_compliance"], RIGID_TOOTH)
        total = np.zeros(self.cranks, complex)
        for s in (1.0, -1.0):
            approach = s * rolled * ca - (distance - r["crank_circle_radius"]) * sa - 0.5 * (r["tooth_backlash"] + r["backlash"])
            along = -s * ca * (small + self.planet) / distance**2
            by_place = along * 1j * crank - sa * crank / distance
            rate = (crank_rate * by_place.conj()).real + s * ca * (self.planet * crank_rates[:, 2] + small * v[sun])
            f = np.where(approach > 0.0, np.maximum(stiffness * (approach + r["joint_damping_time"] * rate), 0.0), 0.0)
            total += f * by_place
            out[carrier + 5 : self.ring : 3] += f * s * self.planet * ca
            out[sun] += (f * s * small * ca).sum()
        return total
