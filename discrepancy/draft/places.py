"""Where a recovered law can act: from "this quantity lacks f(x)" to a hook of a unit, or plainly nowhere.

A law has a place only where a hook changes the measured quantity itself, to first order by f: a torque at the input is
power lost, a turning of the output is a turning of all cranks, a share of the wear is a factor on the coefficient.
What would need a body, a spring in between or a signal's spectrum has none, and the reason is said.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from discrepancy.draft.expression import POWER
from discrepancy.inference.law.recover import Recovered
from discrepancy.inference.law.waves import Growth

PLANT, WEAR = "rv_plant", "wear_fmu"


class NoPlace(Exception):
    """No hook takes this law; the text says why, and what could be done instead."""


@dataclass(frozen=True)
class Drive:
    """What of the reducer a draft must know: input turns per output turn, and lobes of a disc."""

    ratio: float
    lobes: int


@dataclass(frozen=True)
class Axis:
    """How a hook reads x: ``code`` in ``unit``, a letter, what it is; ``per`` x in ``code``'s unit over x as measured; ``needs`` a line before."""

    symbol: str
    text: str
    unit: str
    code: str
    per: float = 1.0
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Place:
    """A hook that takes y = f(x): ``apply`` are its lines, ``y`` being the law and ``slope`` its derivative by x.

    ``unit`` is y's SI unit, ``sign`` y over the measured misfit, ``lost`` whether y cannot be negative; ``law`` and ``text`` say what y
    is; ``signals`` are the quantities that show it; ``rate``: u df/du is added to f, for what adds up over x.
    """

    package: str
    hook: str
    unit: str
    law: str
    text: str
    signals: tuple[str, ...]
    axis: Axis
    apply: tuple[str, ...]
    before: tuple[str, ...] = ()
    imports: Mapping[str, tuple[str, ...]] | None = None
    sign: float = 1.0
    lost: bool = False
    rate: bool = False
    slope: bool = False
    level: bool = True


LOBES = "lobes = r.lobe_gap_added.shape[1]"
RATIO = "ratio = total_ratio(r.first_stage_ratio, lobes + 1, lobes)"
SIDE = "side = 1.0 if r.load_torque >= 0.0 else -1.0"
SPEED_OF_SUN = "speed = abs(r.crank_speed / lobes * ratio)"
LOAD = Axis("M", "torque at the output", "N.m", "abs(r.load_torque)")
TEMPERATURE = Axis("T", "temperature of the contacts", "K", "r.reducer_temperature")
ANGLE = Axis("phi", "turning of the output", "rad", "r.ideal_output")
# ``before`` and ``warm`` come before the speeds of this position are known: there the input's own counts.
INPUT_SPEED = Axis("n", "speed of the input", "rad/s", "abs(r.input_speed)")
CONDITIONS = {"load": LOAD, "speed": INPUT_SPEED, "temperature": TEMPERATURE}
SUN_SPEED = Axis("n", "speed of the input", "rad/s", "speed")
TURNED = ("transmission_error", "hysteresis", "lost_motion")
# What shows a turning that goes with the torque, with the angle, or with neither.
SHOWS = {"torque": ("hysteresis", "lost_motion", "torsional_stiffness"), "angle": ("transmission_error", "input_torque")}
DIRECTIONS = {"direction": "side * ", "load": "abs(r.load_torque) * ", "load and direction": "r.load_torque * "}
SAID = {"direction": "side ", "load": "M ", "load and direction": "side M "}
PER_LOAD = {"load": "/(N.m)", "load and direction": "/(N.m)"}


def place_of(law: Recovered, drive: Drive, zero_known: bool) -> Place:
    """The hook that takes the law; NoPlace where there is none.  ``zero_known``: whether the signal's mean over a run counts."""
    quantity, _, tags = law.signal.partition("[")
    if law.forms[0].name == "constant":
        raise NoPlace(f"{quantity} is off by the same everywhere: that is a gain or an offset and no law")
    if quantity in TURNED:
        return turning(law, quantity, "locked=output" in tags, zero_known)
    if quantity not in PLACES:
        raise NoPlace(f"no hook changes {quantity} itself: {REASONS.get(quantity, 'it follows from others')}")
    return PLACES[quantity](law, drive)


def axis_of(law: Recovered, known: Mapping[str, Axis], where: str) -> Axis:
    if law.leading not in known:
        raise NoPlace(f"the law is one over {law.leading}, which {where} does not know; it knows {', '.join(known)}")
    return known[law.leading]


def turning(law: Recovered, quantity: str, output_held: bool, zero_known: bool) -> Place:
    """A further turning of the output [rad], forwards, as a turning of all cranks: whatever turns it yields the same."""
    if law.factor == "prediction":
        raise NoPlace(
            f"{quantity} is off in proportion to itself: what turns the output is not known before it turns, so that no hook can scale it;"
            " a spring (support_compliance) or a sensor's gain does"
        )
    if quantity == "hysteresis" and law.factor is not None:
        raise NoPlace(f"the loop is off in proportion to the {law.factor} stated for it, which is not the torque that turns the output")
    torque = Axis("M", "torque at the output, its sign with it", "N.m", "r.load_torque")
    known = CONDITIONS | \
        ({"torque": torque} if quantity == "hysteresis" else {"angle": ANGLE} if quantity == "transmission_error" else {})
    axis = axis_of(law, known, "the plant")
    along = axis in (torque, ANGLE)
    if not along and quantity != "lost_motion" and not zero_known:
        raise NoPlace(f"{quantity} counts from a zero that nobody knows: a turning that is the same all through a run does not show in it")
    forwards = {"hysteresis": "-", "lost_motion": "-0.5 * side * ", "transmission_error": ""}[quantity]
    factor, said, size = DIRECTIONS.get(law.factor or "", ""), SAID.get(law.factor or "", ""), ""
    sided = [SIDE] if "side" in forwards + factor else []
    growing = []
    if law.growth:
        grows, code = share_of(law.growth)
        # What the law's axis says, it says at the largest value.
        growing, factor, said = [f"size = max({code}, 1e-9) ** {POWER}"], f"size * {factor}", f"({share_text(law.growth)})^{POWER} {said}"
        size = f"; its size goes with a power of the {grows.text}, {grows.symbol} in {grows.unit}"
    unit = f"rad{PER_LOAD.get(law.factor or '', '')}"
    apply = [
        *growing, f"turn = {forwards}{factor}y",
        "for crank in range(r.crank_turn_added.shape[0]):",
        "    # Rolling on, the cranks turn back by so much for each radian of the output.",
        "    r.crank_turn_added[crank] -= per_turn * turn",
    ]
    if axis is ANGLE:
        apply.append(f"    r.crank_turn_rate[crank] -= per_turn * {forwards}{factor}slope / (ratio - 1.0)")
    lines = [LOBES, *([RATIO] if axis is ANGLE else []), "per_turn = lobes + crank_turn_per_carrier_turn(r.first_stage_ratio)", *sided]
    names = ("crank_turn_per_carrier_turn", "total_ratio") if axis is ANGLE else ("crank_turn_per_carrier_turn",)
    what = {
        "hysteresis": "the input's over the ratio, output held" if output_held else "the output's under torque, input held",
        "lost_motion": "the output's between the torques of either sign",
        "transmission_error": "the output's ahead of ideal kinematics",
    }[quantity]
    text = f"a further turning, {what}; put between sun and cranks, for where in the drive it arises this campaign does not say{size}"
    return Place(
        PLANT, "before(r)", unit, f"turning = {said}", text, SHOWS.get(law.leading, TURNED), axis, tuple(apply), tuple(lines),
        {"rv_plant.gear_stage": names}, slope=axis is ANGLE, level=not along or zero_known,
    )  # fmt: skip


def share_of(growth: Growth) -> tuple[Axis, str]:
    """How a hook reads what the size of a wave goes with, and the share of its largest value there."""
    grows = axis_of_factor(growth.factor)
    return grows, f"({grows.code}{f' - {growth.zero:.6g}' if growth.zero else ''}) / {growth.top:.6g}"


def share_text(growth: Growth) -> str:
    symbol = axis_of_factor(growth.factor).symbol
    return f"{f'({symbol} - {growth.zero:.6g})' if growth.zero else symbol}/{growth.top:.6g}"


def axis_of_factor(factor: str) -> Axis:
    if factor not in CONDITIONS:
        raise NoPlace(f"the size of the wave goes with the {factor}, which the plant does not know; it knows {', '.join(CONDITIONS)}")
    return CONDITIONS[factor]


def torque_lost(law: Recovered, drive: Drive) -> Place:
    """Torque at the input [N.m], as power lost; a share of the predicted torque is one of what the load asks for."""
    axis = axis_of(law, {"speed": SUN_SPEED, "load": LOAD, "temperature": TEMPERATURE}, "a loss")
    share = law.factor == "prediction"
    factor = "abs(r.load_torque / ratio) * " if share else DIRECTIONS.get(law.factor or "", "")
    text = "torque at the input, lost" + (", as a share of what the load asks for" if share else "")
    return Place(
        PLANT, "after(r)", "1" if share else "1" if "load" in (law.factor or "") else "N.m",
        "T_lost = " + ("M/i " if share else SAID.get(law.factor or "", "")), text,
        ("input_torque", "no_load_torque", "efficiency", "temperature"), axis, (f"r.friction_power += {factor}y * speed",),
        (LOBES, RATIO, SPEED_OF_SUN, *([SIDE] if "side" in factor else [])), {"rv_plant.gear_stage": ("total_ratio",)}, lost=True,
    )  # fmt: skip


def share_lost(law: Recovered, drive: Drive) -> Place:
    """Efficiency near 1 falls by the share of the load's power that is lost."""
    if law.factor not in (None, "prediction"):
        raise NoPlace(f"an efficiency that is off in proportion to {law.factor} is no share of the power")
    axis = axis_of(law, {"speed": SUN_SPEED, "load": LOAD, "temperature": TEMPERATURE}, "a loss")
    return Place(
        PLANT, "after(r)", "1", "P_lost/P_load = ", "share of the load's power that is lost; the efficiency falls by it to first order",
        ("efficiency", "input_torque", "no_load_torque", "temperature"), axis, ("r.friction_power += abs(r.load_torque / ratio) * y * speed",),
        (LOBES, RATIO, SPEED_OF_SUN), {"rv_plant.gear_stage": ("total_ratio",)}, sign=-1.0, lost=True,
    )  # fmt: skip


def cage(law: Recovered, drive: Drive) -> Place:
    """Speed of the cages over that of rolling."""
    if law.factor not in (None, "prediction"):
        raise NoPlace(f"a cage's speed that is off in proportion to {law.factor} is no share of rolling")
    axis = axis_of(law, {"speed": SUN_SPEED, "load": LOAD, "temperature": TEMPERATURE}, "a cage")
    if law.factor == "prediction":
        return Place(PLANT, "after(r)", "1", "cage speed / rolling - 1 = ", "share by which the cages run ahead of rolling", ("cage_speed",), axis,
                     ("r.cage_share *= 1.0 + y",), (LOBES, RATIO, SPEED_OF_SUN) if axis is SUN_SPEED else (),
                     {"rv_plant.gear_stage": ("total_ratio",)} if axis is SUN_SPEED else None)  # fmt: skip
    rolling = "rolling = abs(cage_rate(r.crank_speed, r.crank_speed / -lobes, r.inner_race_radius, r.outer_race_radius))"
    return Place(PLANT, "after(r)", "rad/s", "cage speed - rolling = ", "speed by which the cages run ahead of rolling", ("cage_speed",), axis,
                 ("if rolling > 0.0:", "    r.cage_share *= 1.0 + y / rolling"), (LOBES, RATIO, SPEED_OF_SUN, rolling),
                 {"rv_plant.gear_stage": ("total_ratio",), "rv_plant.needle_bearing": ("cage_rate",)})  # fmt: skip


def warming(law: Recovered, drive: Drive) -> Place:
    """Contacts that are warmer than the model has them."""
    if law.factor in ("prediction", "direction", "load and direction"):
        raise NoPlace(f"a temperature that is off in proportion to {law.factor} is no warming")
    axis = axis_of(law, {"speed": INPUT_SPEED, "load": LOAD}, "a warming")
    return Place(PLANT, "warm(r)", f"K{PER_LOAD.get(law.factor or '', '')}", f"T - T_model = {SAID.get(law.factor or '', '')}",
                 "warming of the contacts beyond the model's, reached at once", ("temperature", "lost_motion", "hysteresis", "input_torque"), axis,
                 (f"r.reducer_temperature += {DIRECTIONS.get(law.factor or '', '')}y",))  # fmt: skip


def wearing(law: Recovered, drive: Drive) -> Place:
    """Share of the wear, as a factor on the coefficient; over hours a depth adds up what the coefficient was.

    Wear spreads as it goes on, so that a depth follows by less (a fifth, of flanks worn for long): the fit's amplitude makes up for it.
    """
    if law.factor != "prediction":
        raise NoPlace(
            f"{law.signal.partition('[')[0]} is off by an amount that is no share of the wear: a factor on the wear coefficient is all that acts there"
        )
    if law.leading == "load":
        raise NoPlace("a contact knows its own line load and not the torque: load_exponent of the catalogue says how wear goes with it")
    axis = axis_of(law, {
        "speed": Axis("n", "speed of the cranks", "rad/s", "abs(r.crank_speed)", drive.lobes / abs(drive.ratio)),
        "temperature": Axis("T", "temperature", "K", "r.temperature"),
        "hours": Axis("t", "time of operation", "s", "r.operating_time"),
    }, "a worn contact")  # fmt: skip
    return Place(
        WEAR, "factor(r, surface, line_load, radius, speed, depth)", "1", "k/k_0 - 1 = ", "share by which the wear coefficient is larger",
        ("wear_depth", "wear_profile", "mass_loss", "debris"), axis, ("return max(0.0, 1.0 + y)",), rate=law.leading == "hours",
    )  # fmt: skip


PLACES = {
    "input_torque": torque_lost, "no_load_torque": torque_lost, "efficiency": share_lost, "cage_speed": cage, "temperature": warming,
    "wear_depth": wearing, "wear_profile": wearing, "mass_loss": wearing, "debris_iron": wearing,
}  # fmt: skip
REASONS = {
    "vibration": "an amplitude over time or order is no force on the housing; a force or an error of a part would be",
    "vibration_order": "an amplitude over the order is no force on the housing; a force or an error of a part would be",
    "transmission_order": "an order is no place in the reducer; a curve of the transmission error over the angle would show where it turns",
    "torsional_stiffness": "it is the slope of a loop; measure the loop, whose turning a hook can change",
}  # fmt: skip
