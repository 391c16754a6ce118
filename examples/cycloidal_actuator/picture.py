"""Draws measured and predicted loops of held-out ramps, step by step of the ladder, as docs/actuator_loops.svg.

    python examples/cycloidal_actuator/picture.py FOLDER [OUT.svg]         FOLDER holds the data files
"""

import sys
from pathlib import Path

import numpy as np

from discrepancy.campaign.load import load_campaign
from discrepancy.compare import compare
from discrepancy.extend import extend
from discrepancy.model_file import load_model

HERE = Path(__file__).parent
DRIVES = (("base", "cycloidal-actuator", "plain drive"), ("conic_1pre", HERE / "preloaded.toml", "conic disc, preload 1"))
COLOURS = {"measured": "#9aa5b1", "elastic model": "#c0392b", "with friction": "#d68910", "with play as well": "#1e6fb8"}
WIDTH, HEIGHT, MARGIN = 360, 300, 46
TORQUE, TURNING = 4.5, 110.0


def place(torque, turning, left):
    x = left + MARGIN + (torque + TORQUE) / (2 * TORQUE) * (WIDTH - MARGIN - 10)
    y = 30 + (TURNING - turning) / (2 * TURNING) * (HEIGHT - 80)
    return x, y


def line(torque, turning, left, colour, width):
    points = " ".join("{:.1f},{:.1f}".format(*place(t, a, left)) for t, a in zip(torque, turning))
    return f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="{width}"/>'


def loops(folder, name, model):
    """Torque and turnings [arcmin] of the last held-out ramp, by name of the curve."""
    campaign, file = load_campaign(HERE / name, folder), load_model(model)
    found, torque = {}, None
    for label, effect in zip(list(COLOURS)[1:], (None, "drive_friction", "output_play")):
        if effect:
            file = extend(file, campaign, [effect], anyway=True).file
        shown = compare(file, campaign)
        i = max(i for i, r in enumerate(shown.model.records) if r.held_out)
        record = shown.model.records[i]
        torque, zero = record.axes["torque"], record.values.mean()
        found["measured"] = np.degrees(record.values - zero) * 60
        found[label] = np.degrees(shown.predictions[i] - zero) * 60
    return torque, found


def main(folder: Path, target: Path) -> None:
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{2 * WIDTH}" height="{HEIGHT}" fill="white"/>']  # fmt: skip
    for column, (name, model, title) in enumerate(DRIVES):
        left = column * WIDTH
        torque, curves = loops(folder, name, model)
        (x0, y0), (x1, y1) = place(-TORQUE, -TURNING, left), place(TORQUE, TURNING, left)
        parts.append(f'<rect x="{x0}" y="{y1}" width="{x1 - x0}" height="{y0 - y1}" fill="none" stroke="#444"/>')
        parts.append(f'<text x="{x0}" y="20" font-weight="bold">{title}</text>')
        for tick in (-100, 0, 100):
            x, y = place(-TORQUE, tick, left)
            parts.append(f'<text x="{x - 5:.1f}" y="{y + 4:.1f}" text-anchor="end">{tick}</text>')
        for tick in (-4, 0, 4):
            x, y = place(tick, -TURNING, left)
            parts.append(f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{tick}</text>')
        parts += [line(torque, curves[k], left, colour, 3 if k == "measured" else 1.5) for k, colour in COLOURS.items()]
        parts.append(f'<text x="{(x0 + x1) / 2:.1f}" y="{y0 + 32:.1f}" text-anchor="middle">torque [N m]; turning [arcmin]</text>')
    x = MARGIN
    for label, colour in COLOURS.items():
        parts.append(f'<text x="{x}" y="{HEIGHT - 5}" fill="{colour}">{label}</text>')
        x += 130
    target.write_text("\n".join([*parts, "</svg>"]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2] if len(sys.argv) > 2 else HERE.parents[1] / "docs" / "actuator_loops.svg"))
