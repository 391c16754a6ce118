"""Figures of 2018 to 2026 from data sheets, a public summary and an encyclopedia, beside the library's reducers."""

from itertools import product

import numpy as np

from reproduce.claim import CONDITIONAL, CONTRADICTED, LITERATURE, REPRODUCED, Finding, Number, held, states
from reproduce.context import BX, REAL_BX, REAL_RV, RV, Context
from reproduce.loss_claims import RATED, RATIO, RPM, efficiency, losses
from reproduce.prototypes import loop, peak_to_peak, transmission_error
from reproduce.rig import SUMMARY
from reproduce.unknowns import loop_spans

ENCYCLOPEDIA = "entry of a public encyclopedia of robot parts, reviewed on 13 July 2026"
# Of good parts (assumed): throw of an eccentric, phase of one.
THROW, PHASE = "3um", "2arcmin"
# Teeth of sun and planet of the RV-80E.
SUN, PLANET = 10, 38


@states("L38", LITERATURE, "Feedback of the cranks", f"Yang et al. 2021, Mech. Mach. Theory 163, 104384, by {SUMMARY}: in an RV-80E the carrier's error, fed"
        " back over the first stage, takes about 3 % of an error of the profile.")
def feedback(context: Context) -> Finding:
    fed = (SUN + PLANET) / (PLANET * context.rv80e().topology.lobes)
    share = 100.0 * fed / (1.0 + fed)
    lag, error = (np.asarray(context.contacts(RV).turn[name]).mean() for name in ("lag", "transmission_error"))
    ours = 100.0 * (1.0 - abs(float(error / lag)))
    return Finding(
        REPRODUCED, "A carrier that falls behind turns its planets on the sun, and the cranks with them: at the input the lag of the second stage is that"
            " much smaller.",
        [held("RV-80E by its teeth (10 and 38, 39 lobes, 40 pins)", "%", share, 3.0), Number("RV20E-121-rigid, lag of the second stage over the error at the"
            " input", "%", ours)],
        [("about as theirs", 2.5 < share < 3.5), ("the plant does it", 2.5 < ours < 4.0)],
    )  # fmt: skip


@states("L39", LITERATURE, "Eight errors, chosen to the best", "Wang 2026, ensemble prediction of the transmission error of an RV reducer (journal not in"
        f" what was read), by {SUMMARY}: choosing eight errors by differential evolution lowers the error peak to peak by 52.48 %.")
def chosen_errors(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    names = [f"errors.crank.{name}[{disc},{crank}]={size}" for name, size in (("eccentricity", THROW), ("phase", PHASE))
             for disc, crank in product((1, 2), (1, 2))]
    still = transmission_error(reducer)
    each = np.array([transmission_error(reducer, [name]) - still for name in names])
    signs = np.array(list(product((-1.0, 1.0), repeat=len(names))))
    found = np.ptp(still + signs @ each, axis=1)
    best = signs[int(found.argmin())]
    signed = [name.replace("=", "=-") if sign < 0.0 else name for name, sign in zip(names, best)]
    whole = peak_to_peak(reducer, signed)
    lowered = 100.0 * (1.0 - whole / float(np.median(found)))
    return Finding(
        CONDITIONAL, "Theirs chooses sizes within tolerances, by finite elements without clearance or friction; which is not public. Here eight errors of the"
            " cranks keep their size and choose their signs: they cancel, because throws of one disc pull against those of the other.",
        [held("error taken away by the best signs, over the median of all", "%", lowered, 52.48),
         Number("BX-40E, median of all signs, peak to peak", "arcsec", float(np.median(found))), Number("best signs, computed whole", "arcsec", whole),
         Number("perfect parts", "arcsec", float(np.ptp(still)))],
        [("as much or more can be taken away", lowered > 52.48), ("errors add up", abs(whole - float(found.min())) < 0.15 * float(np.median(found)))],
        "signs of eight errors of the cranks",
    )  # fmt: skip


@states("L41", LITERATURE, "Data sheet of an RV-42N", "Nabtesco, product page of the RV-42N, as read on 3 September 2026 in a public catalogue of parts:"
        " rated 412 N m, 113 N m/arcmin, lost motion and hysteresis below 1 arcmin.")
def data_sheet(context: Context) -> Finding:
    found, spans = loop(context.reducer(REAL_BX)), loop_spans(context, REAL_BX)
    return Finding(
        REPRODUCED, "The compact successor of the RV-40E, of the same rated torque: the library's BX-40E stands within a tenth of its stiffness and below its"
            " limits.",
        [held("BX-40E, rated torque", "N m", RATED[REAL_BX], 412.0), held("BX-40E, stiffness", "N m/arcmin", found.stiffness_Nm_per_arcmin, 113.0,
            spans["stiffness"]),
         held("BX-40E, lost motion", "arcmin", found.lost_motion_arcmin, (0.0, 1.0), spans["lost_motion"]),
         held("BX-40E, width of the loop", "arcmin", found.width_arcmin, (0.0, 1.0))],
        [("stiffness within a tenth", abs(found.stiffness_Nm_per_arcmin / 113.0 - 1.0) < 0.1), ("lost motion and loop below"
            " 1", max(found.lost_motion_arcmin, found.width_arcmin) < 1.0)],
    )  # fmt: skip


@states("L43", LITERATURE, "Four teeth of five in mesh", f"Nantong Zhenkang ZKRV-E, {ENCYCLOPEDIA}: usually more than 80 % of the teeth mesh.")
def teeth_in_mesh(context: Context) -> Finding:
    shares, most = {}, {}
    for name in (RV, BX):
        turn, pins = context.contacts(name).turn, context.reducer(name).topology.pins
        loaded = (np.asarray(turn["mesh_force"]) > 0.0).sum(axis=-1)
        shares[name], most[name] = 100.0 * float(loaded.mean()) / pins, 100.0 * float(loaded.max()) / pins
    return Finding(
        CONTRADICTED, "On one side of the line through both centres pins push, on the other they cannot: half is the most that ideal parts can load (T09),"
            " clearance leaves less. More than four in five are near the disc without carrying anything.",
        [*(held(f"{name}, teeth that carry, mean over a turn", "%", share, (80.0, 100.0)) for name, share in shares.items()),
         *(Number(f"{name}, most at once", "%", share) for name, share in most.items())],
        [("half at the most", max(*shares.values(), *most.values()) <= 52.5)],
    )  # fmt: skip


@states("L44", LITERATURE, "Efficiency of an RV-20E", f"Nabtesco RV-20E-81, {ENCYCLOPEDIA}: typical efficiency above 85 %, backlash below 1 arcmin.")
def typical_efficiency(context: Context) -> Finding:
    ours, span = efficiency(context, REAL_RV), losses(context, REAL_RV)
    best = efficiency(context, REAL_RV, 1.0, RPM, "mesh.friction=0.04", "roller.friction=0.002", "input.seal_torque=0.0276", "input.churning_torque=0.0276")
    found, lost = loop(context.reducer(REAL_RV)), loop_spans(context, REAL_RV)["lost_motion"]
    return Finding(
        CONDITIONAL, "Ours has ratio 121: its input turns half as fast again as theirs of 81, and drags more. 85 % is reached where friction and drag"
        " are all at their lower ends, not in the middle of their ranges.",
        [held("RV20E-121, rated torque at 15"
            " rpm", "%", ours, (85.0, 100.0), span), held("RV20E-121, lost motion", "arcmin", found.lost_motion_arcmin, (0.0, 1.0), lost),
         Number("RV20E-121, friction and drag at their lower ends", "%", best)],
        [("within three points", 82.0 < ours < 85.0), ("above it with all at their lower"
            " ends", best > 85.0), ("lost motion below 1", found.lost_motion_arcmin < 1.0)],
        "friction and drag towards the lower ends of their ranges",
    )  # fmt: skip


@states("L45", LITERATURE, "Efficiency by load and speed", "Wang 2024, nonlinear efficiency of a cycloid reducer (journal not in what was read), by"
        f" {SUMMARY}: at constant load mean efficiency falls with speed, at constant speed it rises with load.")
def load_and_speed(context: Context) -> Finding:
    speeds = {rpm: efficiency(context, REAL_RV, 1.0, rpm) for rpm in (5.0, RPM, 30.0)}
    loads = {share: efficiency(context, REAL_RV, share) for share in (0.25, 0.5, 1.0)}
    return Finding(
        REPRODUCED, "Drag of seals and grease is a smaller share of a larger load; grease drags more when it is sheared faster.",
        [*(Number(f"RV20E-121, rated torque, {rpm:g} rpm", "%", value) for rpm, value in speeds.items()),
         *(Number(f"RV20E-121, {100 * share:g} % of it, {RPM:g} rpm", "%", value) for share, value in loads.items()), Number("ratio", "1", RATIO)],
        [("falls with speed", bool(np.all(np.diff(list(speeds.values())) < 0.0))), ("rises with load", bool(np.all(np.diff(list(loads.values())) > 0.0)))],
    )  # fmt: skip
