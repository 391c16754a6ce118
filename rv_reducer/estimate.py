"""Present lost motion and remaining life by inspections, as a controller or a fleet's twin has them.

    state (L, v): dL = v dt, variance of ln v grows by q dt; a reading z = L + noise, Kalman's gains

``rvwear forecast`` gives what the filter needs: the rate v that is to be expected, the deviation of its logarithm, q, and the noise of a
reading.  A reading is an input that has changed and is above 0; it counts at the next judgement.  With no rate given there is no
filter: the estimates are those of the unit's own wear.

Source: Kalman 1960.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Variable

# A first reading is known to this share before, which is as good as nothing; in a forecast too.
LEVEL_DEVIATION = 0.3
# A rate does not fall below this share of itself by one reading: what is worn does not grow back.
LEAST_SHARE = 0.2
# No end in sight [s]: 30,000 years.
LONGEST_LIFE = 1e12


def variables() -> list[Variable]:
    """Parameters, input, outputs and states of the filter."""

    def parameter(name: str, unit: str, text: str, start: float, nominal: float, display: str = "") -> Variable:
        return Variable(name, "parameter", unit, text, start, minimum=0.0, nominal=nominal, tunable=True,
                        source="rvwear forecast; assumed where it stands as it is", path=f"life.{name}", display=display)

    def state(name: str, unit: str, text: str) -> Variable:
        return Variable(name, "state", unit, text, 0.0)

    return [
        Variable("measured_lost_motion", "input", "rad", "lost motion at the last inspection, new where it changes (0: none yet)", 0.0,
                 minimum=0.0, nominal=1e-4, path="life.measured_lost_motion", display="arcmin"),
        parameter("expected_rate", "rad/s", "growth of lost motion that is expected (0: no filter, estimates follow the unit's own wear)", 0.0,
                  1e-11, "arcsec/h"),
        parameter("rate_deviation", "1", "standard deviation of its logarithm", 1.0, 1.0),
        parameter("rate_drift", "1/s", "growth of the variance of its logarithm", 2e-8, 1e-8),
        parameter("reading_noise", "rad", "standard deviation of a reading", 2e-6, 1e-6, "arcsec"),
        Variable("estimated_lost_motion", "output", "rad", "present lost motion by inspections", nominal=1e-4,
                 path="life.estimated_lost_motion", display="arcmin"),
        Variable("estimated_remaining", "output", "s", "operating time until life.lost_motion_limit by inspections", nominal=1e6,
                 path="life.estimated_remaining"),
        state("estimated_rate", "rad/s", "estimated growth of lost motion"),
        state("level_variance", "rad^2", "of the estimated lost motion"),
        state("level_rate_covariance", "rad^2/s", "of both"),
        state("rate_variance", "rad^2/s^2", "of the estimated rate"),
        state("last_reading", "rad", "reading that was used last"),
        state("estimated_time", "s", "operating time of the estimate"),
    ]  # fmt: skip


@kernel
def start_estimate(r):
    """Of what nobody has inspected yet."""
    r.estimated_lost_motion = r.lost_motion
    r.estimated_rate = r.expected_rate
    r.level_variance = (LEVEL_DEVIATION * r.lost_motion) ** 2
    r.level_rate_covariance = 0.0
    r.rate_variance = (r.expected_rate * r.rate_deviation) ** 2
    r.last_reading = 0.0
    r.estimated_time = r.operating_time
    take_reading(r)
    look_ahead(r)


@kernel
def estimate(r):
    """On to the present operating time, and the reading if it is a new one."""
    if r.expected_rate > 0.0:
        passed = r.operating_time - r.estimated_time
        r.estimated_lost_motion += r.estimated_rate * passed
        r.level_variance += (2.0 * r.level_rate_covariance + r.rate_variance * passed) * passed
        r.level_rate_covariance += r.rate_variance * passed
        r.rate_variance += r.estimated_rate * r.estimated_rate * r.rate_drift * passed
        take_reading(r)
    r.estimated_time = r.operating_time
    look_ahead(r)


@kernel
def take_reading(r):
    """Kalman's update."""
    if r.measured_lost_motion <= 0.0 or r.measured_lost_motion == r.last_reading or r.expected_rate == 0.0:
        return
    r.last_reading = r.measured_lost_motion
    total = r.level_variance + r.reading_noise * r.reading_noise
    of_level, of_rate = r.level_variance / total, r.level_rate_covariance / total
    off = r.measured_lost_motion - r.estimated_lost_motion
    r.estimated_lost_motion += of_level * off
    r.estimated_rate = max(r.estimated_rate + of_rate * off, LEAST_SHARE * r.estimated_rate)
    r.rate_variance -= of_rate * r.level_rate_covariance
    r.level_rate_covariance *= 1.0 - of_level
    r.level_variance *= 1.0 - of_level


@kernel
def look_ahead(r):
    """Time until the limit, at the estimated rate."""
    rate = r.estimated_rate
    if r.expected_rate == 0.0:
        r.estimated_lost_motion = r.lost_motion
        rate = r.own_rate
    r.estimated_remaining = time_until(r.lost_motion_limit, r.estimated_lost_motion, rate)


@kernel
def time_until(limit, present, rate):
    """Time until ``present`` reaches ``limit`` [s]; 0 is no limit."""
    if limit == 0.0:
        return LONGEST_LIFE
    if present >= limit:
        return 0.0
    return (limit - present) / rate if limit - present < rate * LONGEST_LIFE else LONGEST_LIFE
