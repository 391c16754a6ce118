"""An independent twin of the equilibrium: complex numbers, whole arrays, bodies cut free.

Points of the plane are complex numbers in the housing's frame.  The normal of the
flank comes from derivatives of the centre curve, forces from free-body balances; none
of the kernels' formulas for normals, curvatures or levers is used.
"""

import numpy as np


def cross(a, b):
    """Moment of a force b at a lever a (z component)."""
    return (np.conj(a) * b).imag


def directions(count):
    """Unit vectors evenly round the circle."""
    return np.exp(2j * np.pi * np.arange(count) / count)


class Twin:
    """The reducer of one plant record, at one ideal output angle and cage angle."""

    def __init__(self, record, output, cage=0.0, load=None):
        self.r, self.output, self.cage = record, output, cage
        self.load = float(record.load_torque) if load is None else load
        self.discs, self.pins = record.mesh_force.shape
        self.cranks, self.rollers = record.roller_force.shape[1:]
        self.lobes = self.pins - 1
        self.circle = record.pin_circle_radius + record.shift_modification
        self.radius = record.pin_radius + record.equidistant_modification
        self.carrier, self.ring = 3 * self.discs, len(record.z) - 1

    def centre_curve(self, phi, order=0):
        """B(phi) of the lobe on the real axis, or one of its derivatives."""
        z_c, z_p = self.lobes, self.lobes + 1
        slow, fast = np.exp(1j * phi / z_c), np.exp(1j * phi * z_p / z_c)
        return self.circle * (1j / z_c) ** order * slow - self.r.eccentricity * (1j * z_p / z_c) ** order * fast

    def closest(self, centre, phi):
        """Signed distance of points to the centre curve, its outward normal, the phase."""
        for _ in range(30):
            away, first, second = centre - self.centre_curve(phi), *(self.centre_curve(phi, k) for k in (1, 2))
            phi = phi + (away * first.conj()).real / (abs(first) ** 2 - (away * second.conj()).real)
        first = self.centre_curve(phi, 1)
        normal = -1j * first / abs(first)
        return ((centre - self.centre_curve(phi)) * normal.conj()).real, normal, phi

    def place(self, z):
        """Centres and turnings of all parts for the departures z from ideal kinematics."""
        r, theta, per_disc = self.r, self.output, np.arange(self.discs)
        offset = 2 * np.pi * per_disc / self.discs
        self.disc_centre = (r.eccentricity + z[0 : self.carrier : 3] + 1j * z[1 : self.carrier : 3]) * np.exp(
            1j * (offset - self.lobes * theta)
        )
        self.disc_turn = theta + z[2 : self.carrier : 3]
        arms = directions(self.cranks)
        crank = z[self.carrier + 3 : self.ring].reshape(self.cranks, 3)
        shift = z[self.carrier + 1] + 1j * z[self.carrier + 2] + crank[:, 0] + 1j * crank[:, 1]
        nominal = arms * np.exp(1j * (theta + z[self.carrier]))
        seat = r.crank_circle_radius + r.carrier_hole_error_radial + 1j * r.carrier_hole_error_tangential
        self.seat_arm = seat * nominal
        self.crank_centre = self.seat_arm + shift
        self.crank_shift, self.carrier_shift = crank[:, 0] + 1j * crank[:, 1], z[self.carrier + 1] + 1j * z[self.carrier + 2]
        ratio = r.first_stage_ratio
        turn = -self.lobes * theta + crank[:, 2]
        self.push = np.zeros(self.cranks, complex)
        if ratio > 0.0:
            self.planet = r.crank_circle_radius * ratio / (1 + ratio)
            # A tangential tooth force of 1 N: forwards, and outwards by the pressure angle.
            self.push = nominal * (1j + np.copysign(np.tan(r.pressure_angle), self.load))
            turn = turn + (1 + 1 / ratio) * z[self.carrier] + (self.push.conj() * shift).real / self.planet
        self.throw = (r.eccentricity + r.crank_eccentricity_error) * np.exp(
            1j * (turn[None, :] + offset[:, None] + r.crank_phase_error)
        )
        self.lobe_centre = self.crank_centre + self.throw
        hole = r.crank_circle_radius + r.disc_hole_error_radial + 1j * r.disc_hole_error_tangential
        self.hole_frame = arms * np.exp(1j * self.disc_turn)[:, None]
        self.hole_centre = self.disc_centre[:, None] + hole * self.hole_frame
        nominal_pin = directions(self.pins)
        self.pin_centre = nominal_pin * (
            r.pin_circle_radius + r.pin_position_error_radial + 1j * r.pin_position_error_tangential
        ) * np.exp(1j * z[self.ring])

    def penetrations(self, z):
        """Of pins into discs [disc, pin] and of rollers [disc, crank, roller]; keeps normals and phases."""
        self.place(z)
        r = self.r
        offset = 2 * np.pi * np.arange(self.discs)[:, None] / self.discs
        angle = 2 * np.pi * np.arange(self.pins) / self.pins
        # Where the pin stands along the disc, in lobes from root to root.
        along = (self.lobes * (angle - self.output) + offset) / (2 * np.pi)
        root, lobe = np.round(along), np.floor(along).astype(int) % self.lobes
        d = np.arange(self.discs)[:, None]
        pitch = r.lobe_pitch_error[d, lobe] / r.pin_circle_radius
        frame = np.exp(1j * (self.disc_turn[:, None] - offset / self.lobes + 2 * np.pi * root / self.lobes))
        frame = frame * (1 + 1j * pitch) / (1 + pitch**2)
        self.pin_arm = self.pin_centre - self.disc_centre[:, None]
        distance, normal, self.phase = self.closest(self.pin_arm / frame, 2 * np.pi * (along - root))
        self.normal = normal * frame / abs(frame)
        gap = distance + self.radius - r.pin_radius - r.pin_radius_error + r.lobe_profile_error[d, lobe]
        shift = self.lobe_centre - self.hole_centre
        self.roller_direction = self.hole_frame[..., None] * np.exp(1j * self.cage) * directions(self.rollers)
        approach = (shift[..., None] * self.roller_direction.conj()).real
        return -gap - r.mesh_profile_error, approach - r.bearing_clearance - r.roller_profile_error

    def forces(self, z):
        """Contact forces [N] by F = K d^n."""
        mesh, roller = self.penetrations(z)
        return (
            self.r.mesh_constant * np.maximum(mesh, 0.0) ** self.r.mesh_exponent,
            self.r.roller_constant * np.maximum(roller, 0.0) ** self.r.roller_exponent,
        )

    def potential(self, z):
        """Energy of all contacts and springs, and the load's potential [J]."""
        r, energy = self.r, self.load * z[self.carrier]
        for depth, constant, exponent in zip(
            self.penetrations(z), (r.mesh_constant, r.roller_constant), (r.mesh_exponent, r.roller_exponent)
        ):
            energy += constant / (exponent + 1) * np.sum(np.maximum(depth, 0.0) ** (exponent + 1))
        soft = r.compliance > 0.0
        return energy + 0.5 * np.sum(z[soft] ** 2 / r.compliance[soft])

    def balance(self, z, mesh, roller):
        """What is left over on each body cut free, from given contact forces.

        Forces [N] are complex; moments [N m] are about the disc's centre, the crank's
        centre, and the housing's centre for carrier and pin ring.
        """
        self.penetrations(z)
        pull = (roller[..., None] if roller.ndim == 2 else roller) * self.roller_direction
        pull = pull.sum(axis=2)
        disc_force = pull.sum(axis=1) - (mesh * self.normal).sum(axis=1)
        disc_moment = (
            cross(self.lobe_centre - self.disc_centre[:, None], pull).sum(axis=1)
            - cross(self.pin_arm, mesh * self.normal).sum(axis=1)
        )
        # Rollers turn the crank, the sun's tooth on the planet holds it.
        self.crank_moment = -cross(self.throw, pull).sum(axis=0)
        tooth = np.zeros(self.cranks)
        if self.r.first_stage_ratio > 0.0:
            tooth = self.crank_moment / self.planet
        self.tooth = tooth
        support = pull.sum(axis=0) - tooth * self.push
        carrier_moment = -self.load - cross(self.crank_centre, support).sum()
        self.pin_moment = cross(self.pin_centre, mesh * self.normal).sum(axis=1)
        return {
            "disc force": disc_force, "disc moment": disc_moment, "crank support": support,
            "carrier moment": carrier_moment, "carrier force": -support.sum(), "ring moment": self.pin_moment.sum(),
        }
