"""Whether a reducer is in balance: its bodies cut free, by formulas that the kernels do not have.

Points of the plane are complex numbers in the housing's frame.  Places come from the record's departures from ideal kinematics, with all
that errors of parts and effects displace; normals from derivatives of the centre curve; of the forces only their amounts are taken over.
"""

from typing import Any

import numpy as np

Record = Any
# So near to a root [lobes] rounding says which lobe is meant.
ON_ROOT = 1e-9


def cross(a: Any, b: Any) -> Any:
    """Moment of a force b at a lever a (z component)."""
    return (np.conj(a) * b).imag


def round_about(count: int) -> Any:
    return np.exp(2j * np.pi * np.arange(count) / count)


class Bodies:
    """Discs, carrier and cranks of one plant record in equilibrium."""

    def __init__(self, r: Record):
        self.r, self.output = r, float(r["ideal_output"])
        self.discs, self.pins = r["mesh_force_now"].shape
        self.cranks, self.rollers = r["roller_force_now"].shape[1:]
        self.lobes, self.carrier = self.pins - 1, 3 * self.discs
        self.load = float(r["load_torque"])
        ratio = float(r["first_stage_ratio"])
        self.sun_radius = float(r["crank_circle_radius"]) / (1.0 + ratio) if ratio > 0.0 else 0.0
        self.planet_radius = float(r["crank_circle_radius"]) - self.sun_radius if ratio > 0.0 else 0.0
        self.place()

    def place(self) -> None:
        r, z, theta = self.r, self.r["z"], self.output
        offset = 2 * np.pi * np.arange(self.discs) / self.discs
        of_disc = z[: self.carrier].reshape(self.discs, 3)
        self.disc_centre = (r["eccentricity"] + of_disc[:, 0] + 1j * of_disc[:, 1]) * np.exp(1j * (offset - self.lobes * theta))
        self.disc_turn = theta + of_disc[:, 2]
        of_crank = z[self.carrier + 3 : -1].reshape(self.cranks, 3)
        self.carrier_shift = z[self.carrier + 1] + 1j * z[self.carrier + 2]
        shift = self.carrier_shift + of_crank[:, 0] + 1j * of_crank[:, 1]
        arms = round_about(self.cranks)
        nominal = arms * np.exp(1j * (theta + z[self.carrier]))
        seat = r["crank_circle_radius"] + r["carrier_hole_error_radial"] + r["seat_radial_added"]
        seat = seat + 1j * (r["carrier_hole_error_tangential"] + r["seat_tangential_added"])
        turn = -self.lobes * theta + of_crank[:, 2] + r["crank_turn_added"]
        if self.planet_radius:
            # A tooth's force with tangential part 1 N: forwards, and outwards by the pressure angle; the planet rolls on the sun.
            push = nominal * (1j + np.copysign(np.tan(r["pressure_angle"]), self.load))
            turn = turn + z[self.carrier] * (1 + self.sun_radius / self.planet_radius) + (push.conj() * shift).real / self.planet_radius
        throw = r["eccentricity"] + r["crank_eccentricity_error"] + r["throw_added"]
        self.throw = throw * np.exp(1j * (turn + offset[:, None] + r["crank_phase_error"] + r["lobe_turn_added"]))
        self.lobe_centre = seat * nominal + shift + self.throw
        direction = arms * np.exp(1j * self.disc_turn)[:, None]
        self.roller_direction = direction[..., None] * np.exp(1j * r["cage"]) * round_about(self.rollers)
        ring = r["ring_scale"] * (r["pin_x"] + 1j * r["pin_y"]) * np.exp(1j * z[-1])
        self.pin_centre = ring + (r["ring_offset_x"] + 1j * r["ring_offset_y"])[:, None]

    def curve(self, phi: Any, order: int) -> Any:
        """Path of a pin's centre in the disc's frame (root on the real axis), or a derivative of it."""
        circle = self.r["pin_circle_radius"] + self.r["shift_modification"] + self.r["profile_circle_added"]
        slow, fast = 1j / self.lobes, 1j * (self.lobes + 1) / self.lobes
        return circle * slow**order * np.exp(slow * phi) - self.r["eccentricity"] * fast**order * np.exp(fast * phi)

    def along(self) -> Any:
        """Where the pins stand on the discs, in lobes from root to root [disc, pin]."""
        offset = 2 * np.pi * np.arange(self.discs)[:, None] / self.discs
        return (self.lobes * (2 * np.pi * np.arange(self.pins) / self.pins - self.output) + offset) / (2 * np.pi)

    def normals(self, nudge: float) -> Any:
        """Outward normals of the flanks where they are nearest to the pins [disc, pin], which stand ``nudge`` lobes further on."""
        r, disc = self.r, np.arange(self.discs)[:, None]
        offset = 2 * np.pi * disc / self.discs
        along = self.along() + nudge
        root, lobe = np.round(along), np.floor(along).astype(int) % self.lobes
        pitch = (r["lobe_pitch_error"][disc, lobe] + r["lobe_pitch_added"][disc, lobe]) / r["pin_circle_radius"]
        pitch = pitch + np.where(along >= root, 1.0, -1.0) * r["angle_modification"]
        frame = np.exp(1j * (self.disc_turn[:, None] - offset / self.lobes + 2 * np.pi * root / self.lobes + pitch))
        centre = (self.pin_centre - self.disc_centre[:, None]) / frame
        phi = 2 * np.pi * (along - root) + r["phase_shift"]
        for _ in range(6):
            away, first, second = centre - self.curve(phi, 0), self.curve(phi, 1), self.curve(phi, 2)
            phi = phi + (away * first.conj()).real / (abs(first) ** 2 - (away * second.conj()).real)
        first = self.curve(phi, 1)
        return -1j * first / abs(first) * frame

    def output_pins(self) -> tuple[Any, Any, Any]:
        """(forces of the output pins on the discs, centres of the pins, of their holes) [disc, pin]; no forces without such pins."""
        r = self.r
        count = r["output_pin_force"].shape[1]
        arms = r["output_circle_radius"] * round_about(count)
        pin = self.carrier_shift + arms * np.exp(1j * (self.output + r["z"][self.carrier])) + 0 * self.disc_centre[:, None]
        hole = self.disc_centre[:, None] + arms * np.exp(1j * self.disc_turn)[:, None]
        away = pin - hole
        return (r["output_pin_force"] * away / abs(away) if count > 1 else 0 * away), pin, hole

    def left_over(self) -> dict[str, float]:
        """What is out of balance as a share of the largest force (of 30 N at least): discs, carrier with cranks, input, housing.

        A pin that stands on a root to the last bits has either lobe's errors: that is right which is in balance.
        """
        along = self.along()
        on_root = float(abs(along - np.round(along)).min()) < ON_ROOT
        return min((self.left_over_beside(nudge) for nudge in ((-ON_ROOT, ON_ROOT) if on_root else (0.0,))), key=lambda share: share["force on a disc"])

    def left_over_beside(self, nudge: float) -> dict[str, float]:
        r = self.r
        mesh, roller = r["mesh_force_now"], r["roller_force_now"]
        pull, push = (roller * self.roller_direction).sum(axis=2), mesh * self.normals(nudge)
        pins, pin, hole = self.output_pins()
        lever = float(r["pin_circle_radius"])
        scale = max(30.0, abs(self.load) / lever, float(mesh.max()), float(roller.max()), float(abs(pins).max()))
        arm, pin_arm = self.lobe_centre - self.disc_centre[:, None], self.pin_centre - self.disc_centre[:, None]
        crank_moment = -cross(self.throw, pull).sum(axis=0)
        torque = self.sun_radius * crank_moment.sum() / self.planet_radius if self.planet_radius else -crank_moment.sum()
        forces = pull.sum(axis=1) - push.sum(axis=1) + pins.sum(axis=1)
        moments = cross(arm, pull).sum(axis=1) - cross(pin_arm, push).sum(axis=1) + cross(hole - self.disc_centre[:, None], pins).sum(axis=1)
        carrier = torque - self.load - cross(self.lobe_centre, pull).sum() - cross(pin, pins).sum()
        # What the errors of the teeth's way ask of the input besides.
        of_errors = float((crank_moment * r["crank_turn_rate"]).sum())
        losses = float(r["friction_power"]) / float(r["input_speed"]) if abs(r["input_speed"]) > 1e-6 else 0.0
        return {
            "force on a disc": float(abs(forces).max()) / scale,
            "moment on a disc": float(abs(moments).max()) / scale / lever,
            "moment on the carrier": abs(float(carrier)) / scale / lever,
            "torque of the input": abs(float(r["drive_torque"]) - torque + of_errors - losses) / scale / lever,
            "moment of pins and input": abs(-float(cross(self.pin_centre, push).sum()) + torque - self.load) / scale / lever,
        }


def stored_energy(r: Record) -> float:
    """Energy [J] in contacts and supports, K d^(n+1)/(n+1) and z^2/(2 c)."""
    total = 0.0
    stiffness = r["mesh_constant"] * r["pin_stiffness"]
    for force, constant, exponent in (
        (r["mesh_force_now"], stiffness, r["mesh_exponent"]), (r["roller_force_now"], r["roller_constant"], r["roller_exponent"]),
        (r["output_pin_force"], r["output_constant"], r["output_exponent"]),
    ):  # fmt: skip
        total += float(np.sum(force * (force / constant) ** (1.0 / exponent))) / (float(exponent) + 1.0)
    yields = r["compliance"] > 0.0
    return total + float(np.sum(r["z"][yields] ** 2 / (2.0 * r["compliance"][yields])))
