"""A comparison as the page shows it: key figures first, then every run over its axis, residuals in units of the noise, orders."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from discrepancy.compare import Comparison, calibrated_numbers, with_deviation
from discrepancy.doubts.calibrated_deviations import AT_BOUND, deviations_of, stands_at_bound, unsure_text
from discrepancy.figures.figure_digits import figure_texts
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.chance import chance
from discrepancy.page import amounts, spectra, whys
from discrepancy.page.runs import Run, axis_name, axis_of, by_signal, runs_of
from discrepancy.problem import ORDERS
from discrepancy.scales import of_axis
from fmu_src.arrays import Floats
from pages.content import Page
from pages.look import significant
from pages.words import capital, number
from workbench.doubts import apart, cells_of
from workbench.page_words import on_page

# Noise of a run that differs by less than this share is one number.
EVEN = 1e-3
# A prediction for an axis with fewer samples is drawn with dots besides.
FEW = 40
# Samples of a run that is drawn at all.
LEAST = 3


class Columns:
    """Columns of numbers, one behind the other in single precision: what a browser reads without parsing."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []
        self.size = 0

    def add(self, values: Floats) -> dict[str, int]:
        """Where they stand, in numbers from the beginning."""
        plain = np.ascontiguousarray(values, dtype="<f4")
        place = {"from": self.size, "count": int(plain.size)}
        self.parts.append(plain.tobytes())
        self.size += int(plain.size)
        return place

    def bytes(self) -> bytes:
        return b"".join(self.parts)


def view(result: Comparison, page: Page) -> tuple[dict[str, Any], bytes]:
    """(all that is words and few numbers, the columns that it refers to), with what its ``page`` says."""
    model = result.model
    speed = of_axis("speed", model.campaign)
    space, place = result.diagnostician.space, result.diagnostician.localisation
    runs = runs_of(space, result.predictions, speed)
    ratios = {r["run"]: r["ratio"] for r in result.runs}
    columns = Columns()
    named = {f"{order:g}": name for name, family in result.diagnostician.orders.items() for order in family}
    doubts, warnings = apart(page.warnings, model.campaign, result.scale_doubts)
    told = {
        "title": page.title, "conditions": page.conditions, "finding": page.finding,
        "doubts": doubts, "warnings": warnings, "cells": cells_of(page.warnings, model.campaign, diagnosed=bool(model.file.effects)),
        "cards": [asdict(c) for c in page.cards],
        "figures": figures(result.figures), "of_chance": capital(amounts.in_words(result.of_chance)),
        "calibrated": calibrated(result), "unsure": unsure_text(result.diagnostician.space.base).replace("+-", "±"),
        "signals": [signal(name, members, columns, ratios) | {"errors": errors_of(name, result.signals)} for name, members in by_signal(runs).items()],
        "places": [asdict(g) | {"chance": chance(g.p), "why": asdict(whys.of_place(asdict(g), place.level))} for g in place.largest],
        "orders": named, "nuisances": result.nuisances,
    }  # fmt: skip
    return told, columns.bytes()


def calibrated(result: Comparison) -> list[dict[str, str]]:
    """Calibrated numbers as `compare` tells them, with how sure they are where that is known."""
    base = result.diagnostician.space.base
    meanings, deviations = {p.name: p.description for p in result.model.nuisances}, deviations_of(base)
    return [
        {"name": told, "value": with_deviation(value, deviations.get(name, 0.0), scale).replace("+-", "±"),
         "meaning": "; ".join(filter(None, [meanings.get(name, ""), AT_BOUND if stands_at_bound(base, name) else ""]))}
        for name, (told, value, scale) in zip(result.nuisances, calibrated_numbers(result.model, result.nuisances))
    ]


def figures(found: Sequence[KeyFigure]) -> list[dict[str, Any]]:
    """Measured against model in one unit, with the noise; what repeats how often."""
    rows = []
    for f in found:
        unit, (measured, noise, model) = figure_texts(f, f.model)
        rows.append({
            "signal": f.signal, "title": amounts.signal_title(f.signal), "condition": f.condition, "name": f.name, "unit": amounts.pretty(unit),
            "runs": f.runs, "repeated": f.repeated, "off": f.off,
            "why": asdict(whys.of_key_figure(f)), "measured": measured, "noise": noise, "model": model,
        })  # fmt: skip
    return rows


def signal(name: str, members: Sequence[Run], columns: Columns, ratios: dict[str, float]) -> dict[str, Any]:
    """One signal: its runs, each with axis, measured, predicted and noise in the units that a bench reads."""
    first = members[0]
    unit = first.record.unit
    factor, shown = amounts.scale(unit, name)
    series = [run for run in members if over_an_axis(run)]
    told: dict[str, Any] = {
        "signal": name, "title": amounts.signal_title(name), "unit": shown, "held_out": any(r.record.held_out for r in members), "runs": [],
        "singles": [single(run, factor, ratios) for run in members if not over_an_axis(run)],
    }  # fmt: skip
    if series:
        axis = axis_of(series[0])
        told["axis"] = {"name": axis, "title": amounts.axis_title(axis, series[0].speed)}
        told["loop"] = axis == "torque"
        told["runs"] = [drawn(run, factor, columns, ratios) for run in series if axis_of(run) == axis]
        told["spectra"], told["no_orders"] = orders_of([run for run in series if run.series], factor)
    return told


def errors_of(name: str, rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Of a signal its error in times the noise as the table of a comparison has it, fitted runs before held-out ones."""
    return [{"ratio": row["ratio"], "held_out": row["held_out"], "runs": row["runs"]} for row in rows if row["signal"] == name]


def over_an_axis(run: Run) -> bool:
    """Whether there is something to draw a run over, were it of few samples."""
    return axis_name(run.record) is not None and run.measured.size >= LEAST


def drawn(run: Run, factor: float, columns: Columns, ratios: dict[str, float]) -> dict[str, Any]:
    record = run.record
    if record.quantity == ORDERS:
        return stems(run, factor, columns, ratios)
    name = axis_of(run)
    x = amounts.axis_values(name, np.asarray(record.axes[name])[run.kept], run.speed)
    noise = np.broadcast_to(np.asarray(run.noise, np.float64), run.measured.shape)
    # Drawn, but the axis is not stretched for them.
    aside = {"aside": np.flatnonzero(run.outlying).tolist()} if run.outlying.any() else {}
    # Of each sample, for what the page divides by it, where one number does not say it.
    noises = {"noises": columns.add(factor * noise)} if np.ptp(noise) > EVEN * np.median(noise) else {}
    return label(run, ratios) | {
        "samples": int(run.measured.size), "dots": run.measured.size < FEW,
        "x": columns.add(x), "measured": columns.add(factor * run.measured), "predicted": columns.add(factor * run.predicted),
        "residual": columns.add((run.measured - run.predicted) / np.maximum(noise, 1e-300)), "noise": float(factor * np.median(noise)),
        "zero": factor * run.zero,
    } | aside | noises  # fmt: skip


def stems(run: Run, factor: float, columns: Columns, ratios: dict[str, float]) -> dict[str, Any]:
    """A table of orders, of which each is two numbers, a cos p and a sin p: amplitudes, and the size of what is left in units of the noise of either."""
    every = np.asarray(run.record.axes["order"], float)[run.kept]
    orders = np.unique(every)
    noise = float(np.sqrt(np.mean(np.square(run.noise))))

    return label(run, ratios) | {
        "samples": int(orders.size), "dots": False, "stems": True, "noise": factor * noise, "x": columns.add(orders),
        "measured": columns.add(factor * amplitudes_of(every, run.measured)), "predicted": columns.add(factor * amplitudes_of(every, run.predicted)),
        "residual": columns.add(amplitudes_of(every, run.measured - run.predicted) / max(noise, 1e-300)),
    }  # fmt: skip


def amplitudes_of(every: Floats, values: Floats) -> Floats:
    """Of each order, lowest first, the size of its two numbers; ``every`` (n,) says whose they are."""
    return np.array([float(np.linalg.norm(values[every == order])) for order in np.unique(every)])


def label(run: Run, ratios: dict[str, float]) -> dict[str, Any]:
    record = run.record
    return {"run": record.name, "condition": record.condition, "replicate": record.replicate, "held_out": record.held_out, "mounting": record.mounting,
            "ratio": ratios.get(record.name)}  # fmt: skip


def single(run: Run, factor: float, ratios: dict[str, float]) -> dict[str, Any]:
    noise = factor * float(np.sqrt(np.mean(np.square(run.noise))))
    return label(run, ratios) | {
        "measured": [number(factor * v, 4) for v in run.measured], "predicted": [number(factor * v, 4) for v in run.predicted], "noise": number(noise, 2),
        "off": [round(float(v), 2) for v in (factor * (run.measured - run.predicted) / max(noise, 1e-300))],
    }  # fmt: skip


def orders_of(runs: Sequence[Run], factor: float) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """Amplitudes of the whole orders of the output's turn, condition by condition, of the mean of its repetitions; of those without whole turns why."""
    cells: dict[str, list[Run]] = {}
    for run in runs:
        cells.setdefault(run.record.condition, []).append(run)
    found, why = spectra.spectra_of(cells)
    told = []
    for condition, own in found.items():
        held_out, bridged = cells[condition][0].record.held_out, spectra.bridged_text(own.bridged)
        rows = {name: significant(factor * spectra.sizes(values), 4) for name, values in
                (("measured", own.measured), ("predicted", own.predicted), ("residual", own.residual))}  # fmt: skip
        told.append({"condition": condition, "held_out": held_out, "turns": own.turns, "repetitions": own.repetitions, "bridged": bridged} | rows)
    return told, {condition: on_page(reason) for condition, reason in why.items()}
