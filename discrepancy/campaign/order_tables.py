"""Runs of ``transmission_order``: tables of amplitude and phase, or curves of which orders are made; and even curves where a run asks for them."""

import numpy as np

from discrepancy.campaign.file_format import Convention, Run
from discrepancy.campaign.order_analysis import Complex, as_numbers, even_curve, measured_orders, rows_and_parts
from discrepancy.campaign.quantities import AXES, QUANTITIES, VALUE, Quantity
from discrepancy.campaign.series import Series
from discrepancy.problem import ERROR, ORDERS
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault

AXIS_NAMES = {key.name for key in AXES} | {VALUE}


def given_quantity(run: Run) -> Quantity:
    """What the run's columns hold: its quantity, or the curve over the angle of which it wants orders."""
    return QUANTITIES[ERROR if run.quantity == ORDERS and "angle" in {*run.columns, *run.table} else run.quantity]


def as_asked(run: Run, series: Series, zero_known: bool, direction: int, place: str) -> Series:
    """The run's numbers as its record holds them; ``series`` is in SI units, by role."""
    curve = "angle" in series
    require_fitting_keys(run, curve, place)
    if run.quantity == ORDERS:
        return from_curve(run, series, zero_known, place) if curve else from_table(run, series, zero_known, direction, place)
    if run.per_turn is None:
        return series
    even = even_curve(series["angle"], series[VALUE], run.per_turn, place)
    return {VALUE: even.values, "angle": even.angle} | means(series, len(even.values))


def require_fitting_keys(run: Run, curve: bool, place: str) -> None:
    """InputFault for keys that would change nothing."""
    of_curves = run.quantity in (ERROR, ORDERS) and curve
    wrong = [
        (run.per_turn is not None and not of_curves, "per_turn", "is for curves of the transmission error over the angle"),
        (bool(run.orders) and not (of_curves and run.quantity == ORDERS), "orders", f"is for runs of {ORDERS} with the columns of a curve"),
        (run.window != "none" and not (of_curves and run.quantity == ORDERS), "window", f"is for runs of {ORDERS} with the columns of a curve"),
        (run.convention is not None and (curve or run.quantity != ORDERS), "convention",
         "is for tables of orders; of a curve turn the signs by scale = -1 in its columns"),
    ]  # fmt: skip
    for is_wrong, key, says in wrong:
        if is_wrong:
            raise InputFault(f"{place}.{key} {says}; leave it out")
    if run.quantity == ORDERS and curve and not run.orders:
        raise InputFault(f"{place}: says no orders of the curve; add orders = [1, 2, ...], in events per turn of the output")


def from_curve(run: Run, series: Series, zero_known: bool, place: str) -> Series:
    orders = [order for order in dict.fromkeys(run.orders) if zero_known or order != 0.0]
    require_some(orders, place)
    found, _ = measured_orders(series["angle"], series[VALUE], orders, run.window, run.per_turn, place)
    numbers = as_numbers(orders, found)
    return numbers | means(series, len(numbers[VALUE]))


def from_table(run: Run, series: Series, zero_known: bool, direction: int, place: str) -> Series:
    """Amplitude and phase, by the run's convention, as two numbers an order; without order 0 unless its zero is known."""
    order, amplitude = series["order"], series[VALUE]
    require_one_table(order, amplitude, place)
    kept = np.ones(len(order), bool) if zero_known else order != 0.0
    require_some(list(order[kept]), place)
    found = conventional(order, amplitude, series["phase"], run.convention or Convention(), direction)
    numbers = as_numbers(order[kept], found[kept])
    rows, _ = rows_and_parts(order[kept])
    return numbers | {name: column[kept][rows] for name, column in series.items() if name not in AXIS_NAMES}


def conventional(order: Floats, amplitude: Floats, phase: Floats, convention: Convention, direction: int) -> Complex:
    """A_k of TE = output - input/ratio = sum Re(A_k exp(i k theta)), theta counted forward."""
    p = -phase if convention.phase == "minus" else phase
    if convention.wave == "sine":
        p = p - 0.5 * np.pi
    found = np.where(order == 0.0, amplitude, amplitude * np.exp(1j * p))
    if convention.angle == "backward" or (convention.angle == "motion" and direction < 0):
        # cos(k (-theta) + p) = cos(k theta - p)
        found = np.conj(found)
    return np.asarray(-found if convention.minus == "output" else found, np.complex128)


def require_one_table(order: Floats, amplitude: Floats, place: str) -> None:
    levels, counts = np.unique(order, return_counts=True)
    if counts.max() > 1:
        raise InputFault(
            f"{place}: order {levels[counts.argmax()]:g} stands in {counts.max()} rows; a run is one table: select its rows by"
            " where = { ... }, make repetitions runs of their own"
        )
    if np.any(negative := (amplitude < 0.0) & (order > 0.0)):
        raise InputFault(
            f"{place}: amplitude {amplitude[negative][0]:.4g} rad of order {order[negative][0]:g} is negative; amplitudes are half of peak to peak,"
            " their sign belongs into the phase (180 deg)"
        )


def require_some(orders: list[float], place: str) -> None:
    if not orders:
        raise InputFault(f'{place}: has no order but 0, which is the mean and says nothing as long as the zero is free; state zero = "absolute" if it is known')


def means(series: Series, size: int) -> Series:
    """Numbers of the condition that a curve's rows state, as their means."""
    return {name: np.full(size, float(np.mean(column))) for name, column in series.items() if name not in AXIS_NAMES}
