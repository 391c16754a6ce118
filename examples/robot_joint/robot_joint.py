"""A robot joint, new and after 6,000 h: what wear of the reducer does to positioning.

    python examples/robot_joint/robot_joint.py [HOURS]

Controller, drive, motor and arm are small FMUs (the files beside this one); the joint is
the unit RvReducer in motion, turned by the motor's torque.  The arm hangs; it goes to
either side and back, so that its weight turns the other way at each middle: the reducer's
play and wind-up show between rest on one side and on the other.  The controller sees the motor alone, as in most robots: it sees none of that.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from orchestrator.component import InProcess
from orchestrator.system import System, connect
from reducers.reducer import load_reducer
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair

HERE = Path(__file__).parent
FMUS = {"controller": "Controller", "drive": "Drive", "motor": "Motor", "arm": "Arm"}
CONNECTIONS = [
    ("controller.current", "drive.wanted"), ("drive.voltage", "motor.voltage"), ("motor.current", "drive.current"),
    ("motor.torque", "joint.input.torque"), ("joint.input.angle", "motor.angle"),
    ("joint.input.angle", "controller.motor_angle"), ("arm.torque", "joint.output.load_torque"),
    ("joint.output.angle", "arm.angle"), ("joint.output.speed", "arm.speed"),
]  # fmt: skip
RECORDED = ["controller.target", "joint.output.angle", "joint.input.angle", "motor.current"]
STEP = 2e-4
# Rotor and sun, seen at the sun [kg m^2].
ROTOR_INERTIA = 1e-4
ARCSEC = np.degrees(1.0) * 3600.0
# Within this of where it comes to rest the joint has settled [rad].
SETTLED = 5.0 / ARCSEC


def build_fmus(folder: Path) -> dict[str, Path]:
    """The small FMUs of the files beside this one."""
    for name in FMUS.values():
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", HERE / f"{name}.py", "-d", folder, "--no-external-tool"]
        subprocess.run(command, check=True, capture_output=True)
    return {component: folder / f"{name}.fmu" for component, name in FMUS.items()}


def worn_surfaces(reducer, hours: float) -> dict[str, np.ndarray]:
    """Surfaces after a life at rated load and speed."""
    pair = make_pair(reducer)
    life = Life(LifeSettings(hours, tolerance=0.05))
    live(pair, life, lambda state: None, lambda state: None)
    return life.surfaces[-1]


def make_joint(reducer, surfaces: dict[str, np.ndarray]) -> InProcess:
    """The reducer in motion between motor and arm."""
    joint = InProcess("joint", reducer.specification("rv_reducer"))
    for name, value in {"fidelity": 1, "drive": 1, "input.speed": 0.0, "output.load_torque": 0.0,
                        "sun.inertia": ROTOR_INERTIA, "numerics.dynamic_tolerance": 0.03}.items():  # fmt: skip
        joint.set(name, value)
    for name, depth in surfaces.items():
        joint.records[name][0] = depth
    return joint


def make_system(fmus: dict[str, Path], joint: InProcess) -> System:
    return connect(fmus | {"joint": joint}, CONNECTIONS, step=STEP)


def move(system: System, duration: float) -> dict[str, np.ndarray]:
    """Time, target, position error of flange and motor (at the flange) and current."""
    series = system.run(duration, record=RECORDED)
    target, flange = series["controller.target"], series["joint.output.angle"]
    ratio = system["controller.ratio"]
    return {
        "time": series["time"], "target": target, "flange error": flange - target,
        "motor error": series["joint.input.angle"] / ratio - target, "current": series["motor.current"],
    }  # fmt: skip


def figures(run: dict[str, np.ndarray], move_time: float, pause: float) -> dict[str, float]:
    """What positioning is judged by: angles in seconds of arc, times in ms."""
    time, error = run["time"], run["flange error"]
    rest, settling = [], []
    for i in range(round(time[-1] / (move_time + pause))):
        start = i * (move_time + pause) + move_time
        held = (time >= start - 1e-9) & (time <= start + pause + 1e-9)
        rest.append(error[held][-held.sum() // 4 :].mean())
        moving = np.flatnonzero(np.abs(error[held] - rest[-1]) > SETTLED)
        settling.append(time[held][moving[-1]] - start if len(moving) else 0.0)
    up, _, down, _ = rest
    return {
        "largest error [arcsec]": np.abs(error).max() * ARCSEC,
        "largest error at rest [arcsec]": np.abs(rest).max() * ARCSEC,
        "motor's largest error [arcsec]": np.abs(run["motor error"]).max() * ARCSEC,
        "longest settling [ms]": max(settling) * 1e3,
        "between rest on either side [arcsec]": abs(up - down) * ARCSEC,
    }


def draw(runs: dict[str, dict[str, np.ndarray]], page: Path) -> Path:
    """Angle, position error of flange and motor, and current over time, as an HTML page."""
    from plotly.subplots import make_subplots

    rows = {"flange, target [deg]": ("target", np.degrees(1.0)), "flange's error [arcsec]": ("flange error", ARCSEC),
            "motor's error [arcsec at the flange]": ("motor error", ARCSEC), "current [A]": ("current", 1.0)}  # fmt: skip
    figure = make_subplots(len(rows), 1, shared_xaxes=True, subplot_titles=list(rows), vertical_spacing=0.06)
    for (label, run), colour in zip(runs.items(), ("#4a5d73", "#c46a2b")):
        for i, (name, factor) in enumerate(rows.values()):
            figure.add_scatter(x=run["time"], y=factor * run[name], name=label, legendgroup=label, showlegend=i == 0,
                               line={"color": colour, "width": 1.2}, row=i + 1, col=1)  # fmt: skip
    figure.update_xaxes(title="time [s]", row=len(rows))
    figure.update_layout(height=1000, template="plotly_white", title="Robot joint: new, and with a worn reducer")
    page.parent.mkdir(parents=True, exist_ok=True)
    figure.write_html(page)
    return page


def main(hours: float) -> None:
    reducer = load_reducer("RV20E-121")
    runs, found = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        fmus = build_fmus(Path(folder))
        for label, surfaces in {"new": {}, f"after {hours:g} h": worn_surfaces(reducer, hours)}.items():
            joint = make_joint(reducer, surfaces)
            system = make_system(fmus, joint)
            move_time, pause = system["controller.move_time"], system["controller.pause"]
            runs[label] = move(system, 4.0 * (move_time + pause))
            found[label] = figures(runs[label], move_time, pause) | {
                "lost motion of the reducer [arcsec]": joint.get("life.lost_motion") * ARCSEC
            }
            system.close()
    new, worn = found.values()
    print(f"{'':38}" + "".join(f"{label:>14}" for label in found))
    for name in new:
        print(f"{name:38}{new[name]:14.1f}{worn[name]:14.1f}")
    print(draw(runs, Path("results/robot_joint.html")))


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 6000.0)
