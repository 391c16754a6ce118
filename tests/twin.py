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


def centre_curve(phi, lobes, circle, eccentricity, order=0):
    """Path of a pin's centre in the disc's frame (root on the real axis), or a derivative of it."""
    slow, fast = 1j / lobes, 1j * (lobes + 1) / lobes
    return circle * slow**order * np.exp(slow * phi) - eccentricity * fast**order * np.exp(fast * phi)


def outward_normal(phi, lobes, circle, eccentricity):
    tangent = centre_curve(phi, lobes, circle, eccentricity, 1)
    return -1j * tangent / abs(tangent)


class Twin:
    """The reducer of one plant record, at one ideal output angle and cage angle."""

    def __init__(self, record, output, cage=0.0):
        self.r, self.output, self.cage = record, output, cage
        self.load = float(record.load_torque)
        self.discs, self.pins = record.mesh_force.shape
        self.cranks, self.rollers = record.roller_force.shape[1:]
        self.lobes = self.pins - 1
        self.circle = record.pin_circle_radius + record.shift_modification
        self.radius = record.pin_radius + record.equidistant_modification
        self.carrier, self.ring = 3 * self.discs, len(record.z) - 1
        # Without a first stage the cranks are turned by couples.
        self.sun_radius = self.planet_radius = None
        if record.first_stage_ratio > 0.0:
            self.sun_radius = record.crank_circle_radius / (1 + record.first_stage_ratio)
            self.planet_radius = record.crank_circle_radius - self.sun_radius

    def is_turning(self):
        """Which coordinates of z are angles."""
        index = np.arange(self.ring + 1)
        first = np.where(index < self.carrier, index, index - self.carrier - 3)
        return (first % 3 == 2) & (first >= 0) | (index == self.carrier) | (index == self.ring)

    def closest(self, centre, phi):
        """Signed distance of points to the centre curve, and its outward normal there."""
        curve = (self.lobes, self.circle, self.r.eccentricity)
        for _ in range(30):
            away, first, second = (centre - centre_curve(phi, *curve), *(centre_curve(phi, *curve, k) for k in (1, 2)))
            phi = phi + (away * first.conj()).real / (abs(first) ** 2 - (away * second.conj()).real)
        normal = outward_normal(phi, *curve)
        return ((centre - centre_curve(phi, *curve)) * normal.conj()).real, normal

    def place(self, z):
        """Centres and directions of all parts for the departures z from ideal kinematics."""
        r, theta = self.r, self.output
        offset = 2 * np.pi * np.arange(self.discs) / self.discs
        of_disc = z[: self.carrier].reshape(self.discs, 3)
        self.disc_centre = (r.eccentricity + of_disc[:, 0] + 1j * of_disc[:, 1]) * np.exp(
            1j * (offset - self.lobes * theta)
        )
        self.disc_turn = theta + of_disc[:, 2]
        arms = directions(self.cranks)
        of_crank = z[self.carrier + 3 : self.ring].reshape(self.cranks, 3)
        self.carrier_shift = z[self.carrier + 1] + 1j * z[self.carrier + 2]
        self.crank_shift = of_crank[:, 0] + 1j * of_crank[:, 1]
        shift = self.carrier_shift + self.crank_shift
        nominal = arms * np.exp(1j * (theta + z[self.carrier]))
        seat = r.crank_circle_radius + r.carrier_hole_error_radial + 1j * r.carrier_hole_error_tangential
        turn = -self.lobes * theta + of_crank[:, 2]
        self.push = np.zeros(self.cranks, complex)
        if self.planet_radius:
            # A tooth force with tangential part 1 N: forwards, and outwards by the pressure angle.
            self.push = nominal * (1j + np.copysign(np.tan(r.pressure_angle), self.load))
            # The sun stands still: the planet rolls on it, its tooth follows shifts of its centre.
            turn = turn + z[self.carrier] * (1 + self.sun_radius / self.planet_radius)
            turn = turn + (self.push.conj() * shift).real / self.planet_radius
        self.throw = (r.eccentricity + r.crank_eccentricity_error) * np.exp(
            1j * (turn + offset[:, None] + r.crank_phase_error)
        )
        self.lobe_centre = seat * nominal + shift + self.throw
        hole = r.crank_circle_radius + r.disc_hole_error_radial + 1j * r.disc_hole_error_tangential
        self.hole_direction = arms * np.exp(1j * self.disc_turn)[:, None]
        self.hole_centre = self.disc_centre[:, None] + hole * self.hole_direction
        self.roller_direction = self.hole_direction[..., None] * np.exp(1j * self.cage) * directions(self.rollers)
        pins = r.pin_circle_radius + r.pin_position_error_radial + 1j * r.pin_position_error_tangential
        self.pin_centre = directions(self.pins) * pins * np.exp(1j * z[self.ring])

    def penetrations(self, z):
        """Of pins into discs [disc, pin] and of rollers [disc, crank, roller]; keeps normals and arms."""
        self.place(z)
        r, disc = self.r, np.arange(self.discs)[:, None]
        offset = 2 * np.pi * disc / self.discs
        # Where the pin stands along the disc, counted in lobes from root to root.
        along = (self.lobes * (2 * np.pi * np.arange(self.pins) / self.pins - self.output) + offset) / (2 * np.pi)
        root, lobe = np.round(along), np.floor(along).astype(int) % self.lobes
        pitch = r.lobe_pitch_error[disc, lobe] / r.pin_circle_radius
        frame = np.exp(1j * (self.disc_turn[:, None] - offset / self.lobes + 2 * np.pi * root / self.lobes + pitch))
        self.pin_arm = self.pin_centre - self.disc_centre[:, None]
        distance, normal = self.closest(self.pin_arm / frame, 2 * np.pi * (along - root))
        self.normal = normal * frame
        gap = distance + self.radius - r.pin_radius - r.pin_radius_error + r.lobe_profile_error[disc, lobe]
        shift = self.lobe_centre - self.hole_centre
        approach = (shift[..., None] * self.roller_direction.conj()).real
        return -gap - r.mesh_profile_error, approach - r.bearing_clearance - r.roller_profile_error

    def forces(self, z):
        """Contact forces [N] by F = K d^n."""
        mesh, roller = self.penetrations(z)
        return (
            self.r.mesh_constant * np.maximum(mesh, 0.0) ** self.r.mesh_exponent,
            self.r.roller_constant * np.maximum(roller, 0.0) ** self.r.roller_exponent,
        )

    def balance(self, z, mesh, roller):
        """What is left over on each body cut free, from given contact forces.

        Forces [N] are complex.  Moments [N m]: a disc's about its centre, that of the
        carrier with its cranks about the housing's centre.  Keeps the crank moments, the
        forces on the crank supports, the input torque and the pins' moment per disc.
        """
        self.penetrations(z)
        pull = (roller * self.roller_direction).sum(axis=2)
        push = mesh * self.normal
        self.crank_moment = -cross(self.throw, pull).sum(axis=0)
        self.input_torque = -self.crank_moment.sum()
        tooth = np.zeros(self.cranks)
        if self.planet_radius:
            tooth = self.crank_moment / self.planet_radius
            self.input_torque = self.sun_radius * tooth.sum()
        self.support_force = pull.sum(axis=0) - tooth * self.push
        # The pins hold the discs; about the housing's centre, per disc.
        self.pin_moment = -cross(self.pin_centre, push).sum(axis=1)
        arm = self.lobe_centre - self.disc_centre[:, None]
        return {
            "disc force": pull.sum(axis=1) - push.sum(axis=1),
            "disc moment": cross(arm, pull).sum(axis=1) - cross(self.pin_arm, push).sum(axis=1),
            "carrier moment": self.input_torque - self.load - cross(self.lobe_centre, pull).sum(),
        }

    def left_over(self, z):
        """The balance of rigidly supported parts as one vector [N, N, N m per disc; N m]."""
        balance = self.balance(z, *self.forces(z))
        rows = np.stack([balance["disc force"].real, balance["disc force"].imag, balance["disc moment"]], axis=1)
        return np.append(rows.ravel(), balance["carrier moment"])
