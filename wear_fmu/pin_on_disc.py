"""Wear coefficient of the law "run-in and load" from pin-on-disc mass losses.

The law of ``wear_laws`` for a contact sliding under a constant load, and the mass lost:

    K(s) = kss (F/F0)^m [1 + (r - 1) exp(-s/s0)]                             [1]
    Q(s) = rho F/H kss (F/F0)^m [s + (r - 1) s0 (1 - exp(-s/s0))]            [kg]

K (kappa) is dimensionless, s = 2 pi R n t the distance slid, H hardness, rho density.  The tests
are the BX-40E document's (GCr15, 20 to 80 N, R = 25 mm, 30 rpm; no losses printed).  Weighings, the
first too, have independent errors of standard uncertainty u: a loss between two has sqrt(2) u, and
neighbours share a weighing: covariance u^2 (-1, 2, -1), tridiagonal, whitened by its Cholesky factor.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy import linalg, optimize, stats

from fmu_src.arrays import Floats
from fmu_src.variables import ValueFault

NEAR_BOUND, VAGUE = 0.01, 1.0  # distance to a bound, error that tells nothing: in ln(kss, r, s0) or in m
VISIBLE = 2.0  # standard errors that make a loss visible (95 %)
LIMITS = {  # name: unit, lowest, highest, remedy; those of the law lie within the wear unit's bounds
    "normal_force": ("N", 1e-3, 1e5, "give the load on the pin in newtons"),
    "track_radius": ("m", 1e-4, 1.0, "give the radius of the wear track in metres, 25 mm = 0.025"),
    "rotational_speed": ("rev/s", 1e-4, 1e3, "give revolutions per second, 30 rpm = 0.5"),
    "hardness": ("Pa", 1e6, 1e12, "give the indentation hardness in pascals, 60 to 62 HRC is about 7e9"),
    "density": ("kg/m^3", 100.0, 3e4, "give kilograms per cubic metre, steel 7850"),
    "times": ("s", 1e-3, 1e10, "give seconds since the start; leave out time 0, its loss is 0 by definition"),
    "mass_losses": ("kg", -1e-2, 1e-2, "give the mass lost since the start in kilograms, 1 mg = 1e-6"),
    "contact_length": ("m", 1e-5, 1.0, "give the length of the contact line in metres, with every test"),
    "balance_uncertainty": ("kg", 1e-13, 1e-3, "give the standard uncertainty of one weighing, 0.1 mg = 1e-7"),
    "reference_load": ("N", 1e-3, 1e5, "give newtons, or None for the mean of the tests"),
    "wear_coefficient": ("1", 1e-13, 1.0, "give the dimensionless K, not k = K/H"),
    "run_in_ratio": ("1", 1e-2, 1e3, "give K when new over K run in, 1 for no running-in"),
    "run_in_distance": ("m", 1e-6, 1e12, "give metres slid"),
    "load_exponent": ("1", -1.0, 5.0, "give 0 for no dependence on load"),
    "run_in_crank_speed": ("rad/s", 1e-6, 1e5, "give radians per second, 585 rpm = 61.3"),
    "sliding_per_crank_radian": ("m/rad", 1e-9, 1.0, "give metres slid per radian of the crank, about 1e-3"),
}
PARAMETERS = ("wear_coefficient", "run_in_ratio", "run_in_distance", "load_exponent")  # kss, r, s0, m


def checked(name: str, value: object, where: str = "") -> float:
    """``value`` as a float within ``LIMITS``; else a ValueFault with name, value, unit, range and remedy."""
    unit, low, high, remedy = LIMITS[name]
    if not isinstance(value, (int, float, np.number)) or not low <= value <= high:  # NaN too
        raise ValueFault(f"{where}{name} = {value} {unit}: it must be a number in [{low:g}, {high:g}] {unit}; {remedy}")
    return float(value)


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

    def __post_init__(self) -> None:
        for field in filter(LIMITS.get, self.__dataclass_fields__):
            value = getattr(self, field)
            if field in ("times", "mass_losses"):
                row = np.ravel(np.array(value, object))
                value = tuple(checked(field, v, f"{self.name}, reading {i}: ") for i, v in enumerate(row, 1))
            elif value is not None or field not in ("contact_length", "balance_uncertainty"):
                value = checked(field, value, f"{self.name}: ")
            object.__setattr__(self, field, value)
        if len(self.times) != len(self.mass_losses) or not self.times or min(np.diff(self.times), default=1.0) <= 0.0:
            raise ValueFault(f"{self.name}: times = {self.times} s and {len(self.mass_losses)} mass_losses [kg]:"
                             " give at least one reading, one loss per time, each time once and in order")

    @property
    def distances(self) -> Floats:
        """Distance slid at the readings, 2 pi R n t [m]."""
        return 2.0 * np.pi * self.track_radius * self.rotational_speed * np.array(self.times)

    @property
    def mass_per_distance(self) -> float:
        """rho F/H: mass lost per distance slid at K = 1 [kg/m]."""
        return self.density * self.normal_force / self.hardness


def secant_coefficient(test: PinOnDiscTest) -> tuple[Floats, Floats]:
    """(distances [m], SECANT kappa [1]) at the readings: Q H/(rho F s) with the cumulative loss Q.

    The BX-40E document prints this formula and calls it instantaneous.  It is the mean of the
    instantaneous one from 0 to s, so it lags: with r > 1 it lies above, and nears it as 1/s only.
    """
    return test.distances, np.array(test.mass_losses) / (test.mass_per_distance * test.distances)


def instantaneous_coefficient(test: PinOnDiscTest) -> tuple[Floats, Floats]:
    """(middle distances [m], INSTANTANEOUS kappa [1]) of the intervals between readings: H/(rho F) dQ/ds.

    The mean over each interval (the first from the start): equals the law at its middle to
    second order.  Errors of neighbours are negatively correlated.
    """
    s, q = np.append(0.0, test.distances), np.append(0.0, test.mass_losses)
    return 0.5 * (s[1:] + s[:-1]), np.diff(q) / (test.mass_per_distance * np.diff(s))


def smallest_visible_coefficient(test: PinOnDiscTest, balance_uncertainty: float | None = None) -> float:
    """Smallest mean kappa [1] whose loss over the whole test is twice the standard error of a loss.

    2 sqrt(2) u H/(rho F s), u [kg] from the argument or the test; for planning, losses may be
    0.  kappa = 1e-6 at 80 N for 1 h (283 m) removes 25 ug; u = 0.1 mg sees 1.1e-5 or more.
    """
    u = test.balance_uncertainty if balance_uncertainty is None else balance_uncertainty
    loss = VISIBLE * np.sqrt(2.0) * checked("balance_uncertainty", u, f"{test.name}: ")
    return float(loss / (test.mass_per_distance * test.distances[-1]))


@dataclass(frozen=True, eq=False)
class PinOnDiscFit:
    """What the tests say of the law; dictionaries by, and the covariance in the order of, ``PARAMETERS``.

    Do not use a parameter that is in ``flags``: it is on a bound or not determined.  Errors
    are linearised in ln of kss, r, s0 (read them as relative) as if there were no bounds.
    """

    estimates: dict[str, float]  # 1, 1, m, 1; kss at reference_load; NaN where any value fits
    standard_errors: dict[str, float]  # 1, 1, m, 1; 0 if held
    covariance: Floats  # in the same units
    reduced_chi_square: float  # NaN without degrees of freedom or balance_uncertainty
    degrees_of_freedom: int
    balance_uncertainty: float  # kg, given (rms of the tests) or estimated from the residuals
    reference_load: float  # N
    contact_length: float | None  # m
    flags: dict[str, str]  # parameter: reason and remedy
    warnings: tuple[str, ...]  # losses too small to see, chi square too high

    def wear_unit_parameters(self, run_in_crank_speed: float, sliding_per_crank_radian: float) -> dict[str, float]:
        """The wear unit's parameters (SI) for ``mesh_wear_law`` "run-in and load".

        The test counts running-in by distance, exp(-s/s0), the unit by crank travel theta [rad],
        exp(-theta/(run_in_time run_in_crank_speed)).  With the mean sliding length per crank radian
        l, s = l theta and run_in_time = s0/(l run_in_crank_speed) [s].  For the contact, l is the mean
        of ``kinematics.sliding_per_crank_angle`` over a lobe: right for a surface always in contact,
        like the test's pin (assumed).  A point of a flank slides 2 a_H v_s/v_c per pass of a contact of
        half width a_H, z_p/z_c passes a crank turn: l = a_H z_p/(pi z_c) v_s/v_c, tens of times less,
        and run_in_time as much more.  Only K/H is measured: give the unit the tests' hardness.
        """
        for name, reason in self.flags.items():
            raise ValueFault(f"{name} = {self.estimates[name]:g} {LIMITS[name][0]} must not be used: {reason};"
                             f' or hold it at an assumed value, fit(..., held={{"{name}": value}})')
        length = checked("contact_length", self.contact_length, "for reference_line_load: ")
        speed = checked("run_in_crank_speed", run_in_crank_speed)
        slide = checked("sliding_per_crank_radian", sliding_per_crank_radian)
        k, r, s0, m = (self.estimates[name] for name in PARAMETERS)
        return {"mesh_wear_coefficient": k, "run_in_ratio": r, "run_in_time": s0 / (slide * speed),
                "run_in_crank_speed": speed, "load_exponent": m, "reference_line_load": self.reference_load / length}


def whitened_differences(test: PinOnDiscTest, uncertainty: float) -> Floats:
    """Matrix that turns losses [kg] into increments with independent unit errors; u [kg]."""
    of_weighings = np.diff(np.eye(len(test.times) + 1), axis=0)
    root = uncertainty * np.linalg.cholesky(of_weighings @ of_weighings.T)
    return np.linalg.solve(root, of_weighings[:, 1:])


def worn_mass(x: Floats, s: Floats, per_distance: Floats | float, log_load: Floats | float) -> tuple[Floats, Floats]:
    """Q [kg] at distances s [m], and its slopes in x = (ln kss, ln r, ln s0, m); rho F/H [kg/m], ln(F/F0)."""
    (r, s0), gone = np.exp(x[1:3]), -np.expm1(-s / np.exp(x[2]))
    scale = per_distance * np.exp(x[0] + x[3] * log_load)
    q = scale * (s + (r - 1.0) * s0 * gone)
    return q, np.array([q, scale * r * s0 * gone, scale * (r - 1.0) * (s0 * gone - s * (1.0 - gone)), q * log_load]).T


def fit(
    tests: Iterable[PinOnDiscTest], reference_load: float | None = None, held: dict[str, float] | None = None
) -> PinOnDiscFit:
    """Fit the law to a sequence of PinOnDiscTest by least squares on the whitened increments.

    ``reference_load`` F0 [N] None: geometric mean of the loads.  ``held``: values of parameters
    that are not fitted.  s0 is sought from 1/30 of the first to 30 times the last reading.
    """
    tests, held = tuple(tests), held or {}
    weighed, lengths = {t.balance_uncertainty is not None for t in tests}, {t.contact_length for t in tests}
    if len(weighed) != 1 or len(lengths) != 1:
        raise ValueFault(f"tests: {len(tests)}, of contact_length {sorted(map(str, lengths))} m: give one test or more,"
                         " all of one contact_length [m], and balance_uncertainty [kg] in all or in none")
    if not set(held) < set(PARAMETERS):
        raise ValueFault(f"held = {held}: hold some, but not all, of {', '.join(PARAMETERS)}")
    (known,), (length,), counts = weighed, lengths, [len(t.times) for t in tests]
    s, measured = (np.concatenate(rows) for rows in zip(*((t.distances, t.mass_losses) for t in tests)))
    if not measured.max() > 0.0:
        raise ValueFault(f"mass_losses: at most {measured.max():g} kg, nothing is worn; slide further or load more")
    log_loads = np.log([t.normal_force for t in tests])
    f0 = np.exp(log_loads.mean()) if reference_load is None else checked("reference_load", reference_load)
    conditions = s, np.repeat([t.mass_per_distance for t in tests], counts), np.repeat(log_loads - np.log(f0), counts)
    u = np.array([t.balance_uncertainty if known else measured.max() for t in tests])
    whiten = linalg.block_diag(*map(whitened_differences, tests, u))
    x = np.array([checked(name, held[name], "held: ") if name in held else np.nan for name in PARAMETERS])
    low, high = np.array([LIMITS[name][1:3] for name in PARAMETERS]).T
    low[2], high[2] = s.min() / 30.0, 30.0 * s.max()
    for row in (low, high, x):
        row[:3] = np.log(row[:3])
    free = np.isnan(x)

    def evaluate(part: Floats) -> tuple[Floats, Floats]:  # sets x
        x[free] = part
        q, slopes = worn_mass(x, *conditions)
        return whiten @ (q - measured), (whiten @ slopes)[:, free]

    def residuals(part: Floats) -> Floats:
        return evaluate(part)[0]

    def slopes_of(part: Floats) -> Floats:
        return evaluate(part)[1]

    def solve(distance: float) -> optimize.OptimizeResult:
        secant = measured.max() / np.max(s * conditions[1])
        start = np.clip((np.log(secant), 1.0, np.log(distance), 0.3), low, high)[free]
        return optimize.least_squares(residuals, start, slopes_of, (low[free], high[free]), ftol=1e-12, xtol=1e-12, gtol=1e-12,
                                      max_nfev=300)

    found = min(map(solve, np.geomspace(s.min(), s.max(), 3)), key=lambda solution: solution.cost)
    _, singular, v = np.linalg.svd(np.vstack((evaluate(found.x)[1], np.zeros((4, free.sum())))), full_matrices=False)
    lost = singular <= 1e-9 * singular.max()  # directions of x that no reading depends on
    blind = np.isin(range(4), np.flatnonzero(free)[(np.abs(v[lost]) > 1e-3).any(axis=0)])
    freedom = len(s) - int(np.sum(~lost))
    spread = 2.0 * float(found.cost) / freedom if freedom else np.nan  # reduced chi square
    covariance = np.zeros((4, 4))  # of x
    covariance[np.ix_(free, free)] = (1.0 if known else spread) * (v.T / np.where(lost, np.inf, singular) ** 2) @ v
    errors, flags = np.sqrt(np.diag(covariance)), {}
    finer = "slide further, load more or weigh finer"
    reach = (f"readings at {s.min():.3g} to {s.max():.3g} m, s0 about {np.exp(x[2]):.3g} m: {finer}, several times"
             " within s0 and beyond 3 s0; without running-in hold run_in_ratio 1 and any run_in_distance")
    edge = np.minimum(x - low, high - x) < NEAR_BOUND
    for i in np.flatnonzero(free & (blind | edge | ~(errors <= VAGUE))):
        size = f"standard error {errors[i]:.2g}{'' if i == 3 else ' of its logarithm'}"
        reason = "any value fits" if blind[i] else f"on its bound, {size}" if edge[i] else f"not determined, {size}"
        flags[PARAMETERS[i]] = f"{reason}; {(finer, reach, reach, 'test at two or more loads further apart')[i]}"
    warnings = [] if found.status > 0 and (known or freedom) else ["not converged or no errors known: add readings"]
    if known and freedom and stats.chi2.sf(spread * freedom, freedom) < 1e-3:
        warnings.append(f"reduced chi square {spread:.3g} with {freedom} degrees of freedom: more scatter than the"
                        " balance has, or another law; the standard errors are too small by its root or more")
    u = u if known else u * np.sqrt(spread)
    for t, least in zip(tests, VISIBLE * np.sqrt(2.0) * u):
        if t.mass_losses[-1] < least:
            kappa = least / (t.mass_per_distance * t.distances[-1])
            warnings.append(f"{t.name}: mass_losses end at {t.mass_losses[-1]:.2g} kg, the balance sees {least:.2g} kg,"
                            f" a mean kappa of {kappa:.2g} at {t.normal_force:g} N, {t.distances[-1]:.3g} m; {finer}")
    values = np.where(blind, np.nan, np.append(np.exp(x[:3]), x[3]))
    units = np.where(blind, np.nan, np.append(values[:3], 1.0))  # slopes of the parameters in x
    return PinOnDiscFit(
        dict(zip(PARAMETERS, values.tolist())), dict(zip(PARAMETERS, (errors * units).tolist())),
        covariance * np.outer(units, units), spread if known else np.nan, freedom,
        float(np.sqrt(np.mean(u**2))), float(f0), length, flags, tuple(warnings))
