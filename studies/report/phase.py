"""Along a tooth: force, pressure, sliding and wear over the local phase, one below the other."""

import math

import numpy as np

from fmu_src.arrays import Floats
from pages import look
from pages.look import Figure, short
from rv_plant.contact import hertz_peak_pressure
from rv_plant.geometry import flank_curvature
from studies.report.result import MICRON, Result
from studies.report.tooth import loaded_side
from wear_fmu.kinematics import sliding_per_crank_angle

BIN = 2.0  # width of a bin of phase [deg]
GAP = 0.05  # between the four panels, of the height


def contact_phases(result: Result, entry: int, disc: int) -> Floats:
    """Phase of every contact in the middle of its step [position, pin], in degrees from the root."""
    t = result.topology
    angle = np.degrees(result["crank_angle"][entry])
    step = 360.0 / angle.size
    # Ideal positions: the lag, hundredths of a degree, would only spread the bins.
    angle = (np.round(angle / step) - 0.5 * result.sense) * step
    eccentric: Floats = angle + 360.0 * disc / t.discs
    return (eccentric[:, None] + 360.0 * t.lobes / t.pins * np.arange(t.pins)) % 360.0


def force_along(result: Result, entry: int, disc: int) -> tuple[Floats, Floats, Floats, Floats]:
    """(phase, mean, smallest, largest force) in bins of phase, all pins and positions together."""
    phases = contact_phases(result, entry, disc).ravel()
    forces = result["mesh_force"][entry][:, disc, :].ravel()
    bins = (phases / BIN).astype(int)
    used = np.unique(bins)
    groups = [bins == b for b in used]
    return (
        np.array([phases[g].mean() for g in groups]), np.array([forces[g].mean() for g in groups]),
        np.array([forces[g].min() for g in groups]), np.array([forces[g].max() for g in groups]),
    )  # fmt: skip


def pressure_at(result: Result, phases: Floats, forces: Floats) -> Floats:
    """Hertz pressure [MPa] of pin on flank at phases [deg] under forces [N]."""
    circle, radius, k1 = result.generating
    plant = result.plant
    modulus = 0.5 * plant["elastic_modulus"] / (1.0 - plant["poisson_ratio"] ** 2)
    curvatures = [
        1.0 / plant["pin_radius"] + flank_curvature(math.radians(p), result.topology.lobes, circle, radius, k1)
        for p in phases
    ]
    pairs = zip(forces, curvatures)
    return np.array([1e-6 * hertz_peak_pressure(f / plant["mesh_width"], c, modulus) for f, c in pairs])


def sliding_at(result: Result, phases: Floats) -> Floats:
    """Sliding speed of flank on standing pin [mm/s] at phases [deg], closed form."""
    plant, lobes = result.plant, result.topology.lobes
    k1 = plant["eccentricity"] * result.topology.pins / plant["pin_circle_radius"]
    per_angle = [
        sliding_per_crank_angle(math.radians(p), lobes, plant["pin_circle_radius"], plant["pin_radius"], k1)
        for p in phases
    ]
    return 1e3 * abs(result.crank_speed) * np.array(per_angle)


def inflection(result: Result) -> float:
    """Phase [deg] where the flank turns from hollow to round."""
    lobes, (_, _, k1) = result.topology.lobes, result.generating
    return math.degrees(math.acos((1.0 + (lobes + 1) * k1 * k1) / ((lobes + 2) * k1)))


def figure(result: Result) -> Figure:
    """The four panels; force, pressure and wear follow the page's selectors."""
    shown = result.shown
    along = {(d, i): force_along(result, i, d) for d in range(result.topology.discs) for i in shown}
    low, high = loaded_side(result, *(
        np.interp(result["flank_phase"], phases, mean) for phases, mean, _, _ in along.values()
    ))  # fmt: skip
    fine = np.linspace(low, high, 181)
    teeth = MICRON * result["disc_wear"]
    phase_of_bins = result["flank_phase"]
    inside = (phase_of_bins > low) & (phase_of_bins < high)

    def deepest(d: int, i: int) -> Floats:
        tooth: Floats = teeth[i, d][teeth[i, d].max(axis=1).argmax()]
        return tooth[inside]

    def update(d: int, i: int) -> list[look.Trace | int | None]:
        phases, mean, smallest, largest = along[d, i]
        kept = (phases > low - BIN) & (phases < high + BIN)
        phases, mean = phases[kept], mean[kept]
        x, pressure = short(phases), pressure_at(result, phases, mean)
        return [
            {"x": x, "y": short(smallest[kept], 3)}, {"x": x, "y": short(largest[kept], 3)},
            3, {"x": x, "y": short(mean)}, 5, {"x": x, "y": short(pressure)}, None, {"y": short(deepest(d, i))},
        ]  # fmt: skip

    def panel(trace: look.Trace, k: int) -> look.Trace:
        return trace | {"xaxis": "x", "yaxis": "y" if k == 1 else f"y{k}"}

    flank_x = short(phase_of_bins[inside])
    faint = {"mode": "lines", "line": {"width": 0}, "hoverinfo": "skip", "type": "scatter"}
    traces = [
        panel(faint, 1), panel(faint | {"fill": "tonexty", "fillcolor": "rgba(11,79,148,0.16)"}, 1),
        panel(look.line([], [], look.START, hover="start, %{x:.0f}°: %{y:.0f} N"), 1),
        panel(look.line([], [], look.NOW, hover="%{x:.0f}°: %{y:.0f} N"), 1),
        panel(look.line([], [], look.START, hover="start, %{x:.0f}°: %{y:.0f} MPa"), 2),
        panel(look.line([], [], look.NOW, hover="%{x:.0f}°: %{y:.0f} MPa"), 2),
        panel(look.line(short(fine), short(sliding_at(result, fine)), look.INK, hover="%{x:.0f}°: %{y:.0f} mm/s"), 3),
        panel(look.line(flank_x, [], look.NOW, hover="%{x:.0f}°: %{y:.2f} µm", fill="tozeroy",
                        fillcolor="rgba(11,79,148,0.10)"), 4),
    ]  # fmt: skip
    tops = [
        max(float(values[3].max()) for values in along.values()),
        max(float(pressure_at(result, *values[:2]).max()) for values in along.values()),
        float(sliding_at(result, fine).max()), float(teeth[shown].max()) or 1.0,
    ]  # fmt: skip
    titles = ("force [N]", "pressure [MPa]", "sliding [mm/s]", "wear [µm]")
    height = (1.0 - 3 * GAP) / 4.0
    axes = {}
    for k, (title, top) in enumerate(zip(titles, tops)):
        base = (3 - k) * (height + GAP)
        axes["yaxis" if k == 0 else f"yaxis{k + 1}"] = look.axis(
            title, range=[0.0, round(1.08 * top, 4)], domain=[round(base, 4), round(base + height, 4)], nticks=4,
        )
    step = 30.0 if high - low < 200.0 else 60.0
    axes["xaxis"] = look.angle_axis("phase on the tooth [°]: 0 root, 180 tip", low, high, step, anchor="y4")
    bend = inflection(result)
    marks = [look.upright(p, "inflection: hollow to round") for p in (bend, 360.0 - bend) if low < p < high]
    picture = look.layout(**axes, shapes=[m[0] for m in marks], annotations=[m[1] for m in marks],
                          margin={"l": 62, "r": 20, "t": 24, "b": 46})
    states = [[update(d, i) for i in shown] for d in range(result.topology.discs)]
    keys = [("{now}", look.NOW, "solid"), ("{start}", look.START, "solid")]
    return Figure(
        "tooth_phase", "Along the tooth, {now}",
        "Read downwards: what each place of a tooth carries, how fast a standing pin slides there, what it has lost."
        " Band: smallest to largest force of all pins; wear: the deepest tooth of the disc.",
        traces, picture, 12, 640, keys=keys if len(shown) > 1 else [], states=states,
    )  # fmt: skip
