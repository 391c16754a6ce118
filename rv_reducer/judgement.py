"""Lost motion and remaining life, looked at every ``judgement_interval`` of crank turning.

Lost motion is that of the standard stiffness test at one input angle: always the same
one, so that it changes with wear alone.  It costs two equilibria, without the friction that holds an output while the input stands:
what that holds depends on what was before, and a loop with it, whose middle line is read, reads somewhat more.

Remaining life extrapolates along straight lines.  Depths grow in proportion to the volumes, and these at the
rate of the last interval: the deepest place itself moves, and grows by fits and starts.  The growth of lost motion in so
short a time drowns in the equilibrium's tolerance; it is taken as proportional to that of the depths.
"""

from fmu_src.kernel import kernel
from rv_plant.plant import solve
from rv_plant.supports import twist_compliance
from rv_reducer.estimate import LONGEST_LIFE, estimate, start_estimate, time_until
from wear_fmu.contacts import read_profiles

# Share of the rated torque at which lost motion is read.
LOST_MOTION_SHARE = 0.03
# Speed [rad/s] that stands for a standing input there: as slow as none, but nothing sticks.
CREEPING = 1e-9
# Torque over the rated one that no RV reducer survives: catalogues allow 2.5 times at starts and 5 times once in an emergency stop
# (Nabtesco, RV-E and RV-N series: momentary maximum torque).
MOST_RATED = 5.0
CAUTIONS = {
    "overloads": f"output.load_torque is beyond {MOST_RATED:g} times life.rated_torque, the most that catalogues allow for a moment: in the model contacts"
    " stay elastic and bodies linear whatever the torque, real ones yield; contact pressures, stiffness, lost motion and wear are those of no real reducer."
    " life.overloads counts the looks, one each life.judgement_interval, that found it so",
}

NONE, FLANK, RACE, LOST_MOTION = range(4)
# Where a step may end before its time (``pausing``).
NOWHERE, WHERE_JUDGED_OTHERWISE, EVERYWHERE = range(3)


@kernel
def turning_under(p, load_torque, z):
    """(found, turning of the output [rad]) at rest; starts from ``z`` and leaves the equilibrium there."""
    p.load_torque = load_torque
    for i in range(z.shape[0]):
        p.z[i] = z[i]
    found = solve(p)
    for i in range(z.shape[0]):
        z[i] = p.z[i]
    return found, p.z[3 * p.roller_force.shape[0]] - twist_compliance(p) * load_torque


@kernel
def measure_lost_motion(records):
    """Update ``lost_motion``; it stays what it was where there is no equilibrium."""
    r, p, w = records[0], records.plant[0], records.wear[0]
    for i in range(r.kept.shape[0]):
        r.kept[i] = r.cells[i]
    p.ideal_output = p.cage = 0.0
    p.crank_angle = p.output_angle = p.cage_angle = 0.0
    read_profiles(w, 0.0, w.mesh_profile_error, w.roller_profile_error)
    if p.input_speed == 0.0:
        p.input_speed = CREEPING
    torque = LOST_MOTION_SHARE * r.rated_torque
    found_forward, forward = turning_under(p, torque, r.z_forward)
    found_backward, backward = turning_under(p, -torque, r.z_backward)
    for i in range(r.kept.shape[0]):
        r.cells[i] = r.kept[i]
    if found_forward and found_backward:
        r.lost_motion = abs(forward - backward)


@kernel
def find_worst_depths(r):
    """And the volume of the races of which one is the deepest."""
    r.worst_flank_depth = r.worst_pin_depth = inner = outer = 0.0
    for d in range(r.flank_depth.shape[0]):
        r.worst_flank_depth = max(r.worst_flank_depth, r.flank_depth[d])
        for j in range(r.pin_depth.shape[1]):
            r.worst_pin_depth = max(r.worst_pin_depth, r.pin_depth[d, j])
        for c in range(r.inner_race_depth.shape[1]):
            inner, outer = max(inner, r.inner_race_depth[d, c]), max(outer, r.outer_race_depth[d, c])
    r.worst_race_depth = max(inner, outer)
    return r.inner_race_volume if inner > outer else r.outer_race_volume


@kernel
def growth(depth, volume, judged_volume, passed):
    """Rate of a depth [m/s] whose volume has grown since the last judgement ``passed`` [s] ago."""
    return depth * (volume - judged_volume) / (volume * passed) if volume > 0.0 else 0.0


@kernel
def extrapolate_life(r, flank_rate, race_rate):
    """``remaining_life`` and ``limited_by`` from the rates of the depths [m/s]."""
    depth = r.worst_flank_depth + r.worst_race_depth
    lost_motion_rate = 0.0
    if depth > 0.0:
        lost_motion_rate = (r.lost_motion - r.new_lost_motion) * (flank_rate + race_rate) / depth
    r.own_rate = lost_motion_rate
    r.remaining_life, r.limited_by = LONGEST_LIFE, NONE
    flank = time_until(r.flank_depth_limit, r.worst_flank_depth, flank_rate)
    if flank < r.remaining_life:
        r.remaining_life, r.limited_by = flank, FLANK
    race = time_until(r.race_depth_limit, r.worst_race_depth, race_rate)
    if race < r.remaining_life:
        r.remaining_life, r.limited_by = race, RACE
    lost_motion = time_until(r.lost_motion_limit, r.lost_motion, lost_motion_rate)
    if lost_motion < r.remaining_life:
        r.remaining_life, r.limited_by = lost_motion, LOST_MOTION


@kernel
def pauses(r, limited_by, was_over, left):
    """Whether a step ends here, ``left`` [s] before its time: judged is otherwise than at its beginning."""
    if left <= 0.0 or r.pausing == NOWHERE:
        return False
    return r.pausing == EVERYWHERE or r.limited_by != limited_by or (r.remaining_life == 0.0) != was_over


@kernel
def look_at_load(records):
    r = records[0]
    if abs(records.plant[0].load_torque) > MOST_RATED * r.rated_torque:
        r.overloads += 1


@kernel
def start_judgement(records):
    """Of new surfaces, or of worn ones that say what lost motion was when they were new."""
    r = records[0]
    find_worst_depths(r)
    measure_lost_motion(records)
    if r.new_lost_motion == 0.0:
        r.new_lost_motion = r.lost_motion
    extrapolate_life(r, 0.0, 0.0)
    start_estimate(r)
    look_at_load(records)


@kernel
def judge(records, turned):
    """After a step in which the cranks turned by ``turned`` [rad]."""
    r = records[0]
    race_volume = find_worst_depths(r)
    r.turned += turned
    passed = r.operating_time - r.judged_time
    # Judged is where the surfaces wear, next to the end of the interval.
    if r.turned < r.judgement_interval - 0.25 * r.largest_crank_step or not passed > 0.0:
        return
    measure_lost_motion(records)
    judged_race = r.judged_inner_volume if race_volume == r.inner_race_volume else r.judged_outer_volume
    flank_rate = growth(r.worst_flank_depth, r.flank_volume, r.judged_flank_volume, passed)
    extrapolate_life(r, flank_rate, growth(r.worst_race_depth, race_volume, judged_race, passed))
    estimate(r)
    look_at_load(records)
    # What is missing comes on top of the next interval.
    r.judged_time, r.turned = r.operating_time, min(r.turned - r.judgement_interval, 0.0)
    r.judged_flank_volume = r.flank_volume
    r.judged_inner_volume, r.judged_outer_volume = r.inner_race_volume, r.outer_race_volume
