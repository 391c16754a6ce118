"""Wear coefficient of the law "run-in and load" from pin-on-disc mass losses.

The law of ``wear_laws`` for a contact sliding under a constant load, and the mass lost:

    K(s) = kss (F/F0)^m [1 + (r - 1) exp(-s/s0)]                             [1]
    Q(s) = rho F/H kss (F/F0)^m [s + (r - 1) s0 (1 - exp(-s/s0))]            [kg]

K (kappa) is dimensionless, s = 2 pi R n t the distance slid, H hardness, rho density.
The BX-40E document gives such tests (GCr15, 20 to 80 N, track radius 25 mm, 30 rpm)
and the formula Q H/(rho F s); it prints no losses.

Weighings, the one before the start included, have independent errors of standard
uncertainty u.  A loss between two weighings has sqrt(2) u, and neighbours share a
weighing: their covariance is tridiagonal, u^2 (-1, 2, -1).  The fit whitens these
increments by its Cholesky factor.  u is the balance's, not the scatter of specimens.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag, cholesky, solve_triangular
from scipy.optimize import least_squares
from scipy.special import ellipe
from scipy.stats import chi2

from fmu_src.variables import ValueFault

PARAMETERS = ("wear_coefficient", "run_in_ratio", "run_in_distance", "load_exponent")  # kss, r, s0, m
NEAR_BOUND = 0.01  # of ln(parameter), or of the load exponent
VAGUE = 1.0  # standard error of ln(parameter), or of the load exponent, that tells nothing
VISIBLE = 2.0  # standard errors that make a loss visible (95 %)

LIMITS = {  # name: unit, lowest, highest, remedy; those of the law lie within the wear unit's bounds
    "normal_force": ("N", 1e-3, 1e5, "give the load on the pin in newtons"),
    "track_radius": ("m", 1e-4, 1.0, "give the radius of the wear track in metres, 25 mm = 0.025"),
    "rotational_speed": ("rev/s", 1e-4, 1e3, "give revolutions per second, 30 rpm = 0.5"),
    "hardness": ("Pa", 1e6, 1e12, "give the indentation hardness in pascals, 60 to 62 HRC is about 7e9"),
    "density": ("kg/m^3", 100.0, 3e4, "give kilograms per cubic metre, steel 7850"),
    "times": ("s", 1e-3, 1e10, "give seconds since the start; leave out time 0, its loss is 0 by definition"),
    "mass_losses": ("kg", -1e-2, 1e-2, "give the mass lost since the start in kilograms, 1 mg = 1e-6"),
    "contact_length": ("m", 1e-5, 1.0, "give metres, or None if unknown"),
    "balance_uncertainty": ("kg", 1e-13, 1e-3, "give the standard uncertainty of one weighing, 0.1 mg = 1e-7"),
    "reference_load": ("N", 1e-3, 1e5, "give newtons, or None for the mean of the tests"),
    "wear_coefficient": ("1", 1e-13, 1.0, "give the dimensionless K, not k = K/H"),
    "run_in_ratio": ("1", 1e-2, 1e3, "give K when new over K run in, 1 for no running-in"),
    "run_in_distance": ("m", 1e-6, 1e12, "give metres slid"),
    "load_exponent": ("1", -1.0, 5.0, "give 0 for no dependence on load"),
    "run_in_crank_speed": ("rad/s", 1e-6, 1e5, "give radians per second, 585 rpm = 61.3"),
    "sliding_per_crank_radian": ("m/rad", 1e-9, 1.0, "see mean_sliding_per_crank_radian"),
}


def checked(name: str, value, where: str = "") -> float:
    """``value`` as a float within ``LIMITS``; else a ValueFault with name, value, unit, range and remedy."""
    unit, low, high, remedy = LIMITS[name]
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueFault(f"{where}{name} = {value!r} is not a number in {unit}; {remedy}") from None
    if not low <= number <= high:  # NaN too
        raise ValueFault(f"{where}{name} = {number:g} {unit}: it must lie in [{low:g}, {high:g}] {unit}; {remedy}")
    return number


@dataclass(frozen=True)
class PinOnDiscTest:
    """One specimen under one load, weighed before the start and after each of ``times``."""

    normal_force: float  # N
    track_radius: float  # m, of the wear track on the disc
    rotational_speed: float  # rev/s
    hardness: float  # Pa, of the weighed part
    density: float  # kg/m^3, of the weighed part
    times: tuple[float, ...]  # s of sliding since the start, rising, without 0
    mass_losses: tuple[float, ...]  # kg since the start (cumulative); noise may make one negative
    contact_length: float | None = None  # m, turns load into line load
    balance_uncertainty: float | None = None  # kg, standard uncertainty of one weighing
    name: str = "test"

    def __post_init__(self):
        for field in ("normal_force", "track_radius", "rotational_speed", "hardness", "density",
                      "contact_length", "balance_uncertainty"):
            value = getattr(self, field)
            if value is not None or field not in ("contact_length", "balance_uncertainty"):
                object.__setattr__(self, field, checked(field, value, f"{self.name}: "))
        for field in ("times", "mass_losses"):
            row = np.ravel(np.asarray(getattr(self, field), dtype=object))
            row = tuple(checked(field, value, f"{self.name}, reading {i}: ") for i, value in enumerate(row, 1))
            object.__setattr__(self, field, row)
        if len(self.times) != len(self.mass_losses) or not self.times:
            raise ValueFault(f"{self.name}: {len(self.times)} times [s], but {len(self.mass_losses)} mass_losses [kg];"
                             " give one loss per time, at least one")
        for i, (before, after) in enumerate(zip(self.times, self.times[1:]), 2):
            if after <= before:
                raise ValueFault(f"{self.name}, reading {i}: times = {after:g} s does not follow {before:g} s;"
                                 " sort the readings, merge those of one time")

    @property
    def distances(self) -> np.ndarray:
        """Distance slid at the readings, 2 pi R n t [m]."""
        return 2.0 * math.pi * self.track_radius * self.rotational_speed * np.array(self.times)

    @property
    def mass_per_distance(self) -> float:
        """rho F/H: mass lost per distance slid at K = 1 [kg/m]."""
        return self.density * self.normal_force / self.hardness


def secant_coefficient(test: PinOnDiscTest) -> tuple[np.ndarray, np.ndarray]:
    """(distances [m], SECANT kappa [1]) at the readings: Q H/(rho F s) with the cumulative loss Q.

    The BX-40E document prints this formula and calls it instantaneous.  It is the mean of
    the instantaneous coefficient from 0 to s, so it lags: with running-in it lies above
    it, and still falls like 1/s when that has settled.  dh = kappa p ds needs the other.
    """
    s = test.distances
    return s, np.array(test.mass_losses) / (test.mass_per_distance * s)


def instantaneous_coefficient(test: PinOnDiscTest) -> tuple[np.ndarray, np.ndarray]:
    """(middle distances [m], INSTANTANEOUS kappa [1]) of the intervals between readings: H/(rho F) dQ/ds.

    A value is the mean over its interval (the first from the start); at the middle it
    equals the law to second order.  Errors of neighbours are negatively correlated.
    """
    s, q = np.append(0.0, test.distances), np.append(0.0, test.mass_losses)
    return 0.5 * (s[1:] + s[:-1]), np.diff(q) / (test.mass_per_distance * np.diff(s))


def smallest_visible_coefficient(test: PinOnDiscTest, balance_uncertainty: float | None = None) -> float:
    """Smallest mean kappa [1] whose loss over the whole test is twice the standard error of a loss.

    2 sqrt(2) u H/(rho F s), u [kg] from the argument or the test; losses are not looked
    at (zeros do for planning).  kappa = 1e-6 at 80 N for 1 h of the document's test
    (283 m) removes 25 ug; u = 0.1 mg shows 1.1e-5.
    """
    u = checked("balance_uncertainty", balance_uncertainty or test.balance_uncertainty, f"{test.name}: ")
    return VISIBLE * math.sqrt(2.0) * u / (test.mass_per_distance * test.distances[-1])


def mean_sliding_per_crank_radian(lobes: int, pin_circle_radius: float, pin_radius: float, eccentricity: float) -> float:
    """Mean over a crank turn of the contact's sliding (R sqrt(S) - r)/z_c of ``kinematics`` [m/rad]; lengths [m]."""
    k1 = eccentricity * (lobes + 1) / pin_circle_radius
    mean_distance = 2.0 / math.pi * (1.0 + k1) * ellipe(4.0 * k1 / (1.0 + k1) ** 2)  # of sqrt(S)
    return (pin_circle_radius * mean_distance - pin_radius) / lobes


@dataclass(frozen=True, eq=False)
class PinOnDiscFit:
    """What the tests say of the law; dictionaries by, and the covariance in the order of, ``PARAMETERS``.

    Do not use a parameter that ``flags`` names, with the reason: on a bound (errors of
    the others then hold for that value) or not determined.  Errors are linearised in ln
    of kss, r, s0: read them as relative.  Held: 0; without an error: NaN.
    """

    estimates: dict[str, float]  # 1, 1, m, 1; kss at reference_load
    standard_errors: dict[str, float]  # 1, 1, m, 1
    covariance: np.ndarray  # in the same units
    reduced_chi_square: float  # NaN without degrees of freedom or balance_uncertainty
    degrees_of_freedom: int
    balance_uncertainty: float  # kg, given (rms of the tests) or else estimated from the residuals
    reference_load: float  # N
    contact_length: float | None  # m
    flags: dict[str, str]
    warnings: tuple[str, ...]  # losses that the balance cannot see, chi square too high

    def wear_unit_parameters(self, run_in_crank_speed: float, sliding_per_crank_radian: float) -> dict[str, float]:
        """The wear unit's parameters (SI) for ``mesh_wear_law`` "run-in and load".

        The test counts running-in by distance, exp(-s/s0), the unit by crank travel theta
        [rad], exp(-theta/(run_in_time run_in_crank_speed)).  With the mean sliding length
        per crank radian l, s = l theta and run_in_time = s0/(l run_in_crank_speed) [s].
        ``mean_sliding_per_crank_radian`` is l of the contact, which fits a surface always
        in contact, like the test's pin (assumed).  A point of a flank slides 2 a_H v_s/v_c
        per pass of a contact of half width a_H, z_p/z_c passes per crank turn:
        l = a_H z_p/(pi z_c) v_s/v_c is tens of times less, run_in_time as much longer.
        Only K/H is measured: the unit's ``hardness`` must be the tests'.
        """
        for name, reason in self.flags.items():
            raise ValueFault(f"{name} = {self.estimates[name]:g} {LIMITS[name][0]} must not be used: {reason};"
                             f' or hold it at an assumed value, fit(..., held={{"{name}": value}})')
        if self.contact_length is None:
            raise ValueFault("contact_length = None m: reference_line_load [N/m] needs it; give it in the tests")
        speed = checked("run_in_crank_speed", run_in_crank_speed)
        slide = checked("sliding_per_crank_radian", sliding_per_crank_radian)
        k, r, s0, m = self.estimates.values()
        return {"mesh_wear_coefficient": k, "run_in_ratio": r, "run_in_time": s0 / (slide * speed),
                "run_in_crank_speed": speed, "load_exponent": m,
                "reference_line_load": self.reference_load / self.contact_length}


def whitened_differences(test: PinOnDiscTest, uncertainty: float) -> np.ndarray:
    """Matrix that turns losses [kg] into increments with independent unit errors."""
    n = len(test.times)
    of_weighings = np.eye(n, n + 1, 1) - np.eye(n, n + 1)
    root = uncertainty * cholesky(of_weighings @ of_weighings.T, lower=True)
    return solve_triangular(root, of_weighings[:, 1:], lower=True)


def worn_mass(x, s, mass_per_distance, log_load):
    """Q [kg] at distances s [m], and its slopes in x = (ln kss, ln r, ln s0, m); rho F/H [kg/m], ln(F/F0)."""
    r, s0 = np.exp(x[1:3])
    gone = -np.expm1(-s / s0)
    scale = mass_per_distance * np.exp(x[0] + x[3] * log_load)
    q = scale * (s + (r - 1.0) * s0 * gone)
    slopes = [q, scale * r * s0 * gone, scale * (r - 1.0) * (s0 * gone - s * (1.0 - gone)), q * log_load]
    return q, np.column_stack(slopes)


def fit(tests, reference_load: float | None = None, held: dict[str, float] | None = None) -> PinOnDiscFit:
    """Fit the law to a sequence of PinOnDiscTest by least squares on the whitened increments.

    ``reference_load`` F0 [N] None: geometric mean of the loads, where kss and m are least
    correlated.  ``held`` gives parameters that are not fitted (no running-in: ratio 1 and
    any distance).  kss, r, s0 are fitted as logarithms, s0 within 1/30 of the first and
    30 times the last reading.
    """
    tests, held = tuple(tests), {name: checked(name, value, "held: ") for name, value in (held or {}).items()}
    u, length = shared(tests, "balance_uncertainty"), shared(tests, "contact_length")
    s, a, measured, force = (np.concatenate(rows) for rows in zip(*(
        (t.distances, np.full(len(t.times), t.mass_per_distance), t.mass_losses,
         np.full(len(t.times), t.normal_force)) for t in tests)))
    loads = [t.normal_force for t in tests]
    f0 = checked("reference_load", np.exp(np.mean(np.log(loads))) if reference_load is None else reference_load)
    if not max(t.mass_losses[-1] for t in tests) > 0.0:
        raise ValueFault(f"mass_losses = {measured.max():g} kg at most: nothing is worn; slide further or load more")
    unit = u or measured.max()
    whiten = block_diag(*(whitened_differences(t, unit) for t in tests))

    def residuals(x):
        return whiten @ (worn_mass(x, s, a, np.log(force / f0))[0] - measured)

    def jacobian(x):
        return whiten @ worn_mass(x, s, a, np.log(force / f0))[1]

