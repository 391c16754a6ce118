"""What a campaign may measure and what it must say about it: one table.

The check, the template, the readers' roles and the table in docs/campaigns.md follow from
it; a new quantity is one more entry here.
"""

from dataclasses import dataclass

from discrepancy.held_names import HELD, LOCKED_AT

# The role of the column (or number) that holds the quantity itself.
VALUE = "value"
# What an empty campaign measures unless told otherwise.
USUAL = ("transmission_error", "hysteresis", "input_torque")
# Both encoders of a transmission error, in place of its value.
ENCODERS = {"angle", "input_angle"}


@dataclass(frozen=True)
class Key:
    """A key of the file that stands for an axis or a factor.

    One axis or factor may have several keys: a speed is stated at the input or at the output.
    ``per_ratio`` is the power of the reducer's ratio that leads from the stated number to the
    one in the records.  ``minimum`` is what physics allows at least, in the SI unit.
    """

    key: str
    name: str
    unit: str
    example: str
    description: str
    per_ratio: int = 0
    minimum: float | None = None


@dataclass(frozen=True)
class Tag:
    """A word that says which part is meant; ``choices`` is empty where any word will do.

    ``counted`` names the count of the reducer's topology where the word is a number from 1.
    """

    name: str
    description: str
    choices: tuple[str, ...] = ()
    counted: str = ""


@dataclass(frozen=True)
class Quantity:
    """A measured quantity.  ``axes`` must be given, ``optional_axes`` may be.

    ``factors`` are what the model needs to know of the condition, as a number of the
    condition or as a column.
    """

    name: str
    unit: str
    usual_unit: str
    description: str
    axes: tuple[str, ...] = ()
    optional_axes: tuple[str, ...] = ()
    factors: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    optional_tags: tuple[str, ...] = ()


AXES = (
    Key("angle", "angle", "rad", "deg", "angle of the output against the housing, running on over full turns; see angle_of"),
    Key("input_angle", "angle", "rad", "deg", "angle of the input, running on; divided by the ratio", -1),
    Key("time", "time", "s", "s", "time since any start"),
    Key("torque", "torque", "N.m", "N.m", "torque at the output, both signs, in the order it was applied"),
    Key("order", "order", "1", "1", "events per turn of the output", 0, 0.0),
    Key("input_order", "order", "1", "1", "events per turn of the input; multiplied by the ratio", 1, 0.0),
    Key("phase", "phase", "rad", "deg", "phase of a wave, see the conventions of order tables; 0 for order 0"),
    Key("depth_angle", "depth_angle", "rad", "deg",
        "place on the surface. Flank: 0 at a root, 180 deg at the tip, counted over one lobe; pin: from its inward radial;"
        " inner race: from the eccentric's direction; outer race: from the hole's outward radial; races the way the"
        " cranks turn"),
)  # fmt: skip

FACTORS = (
    Key("input_speed", "speed", "rad/s", "1815 rpm", "speed of the input, without sign", 0, 0.0),
    Key("output_speed", "speed", "rad/s", "15 rpm", "speed of the output, without sign; multiplied by the ratio", 1, 0.0),
    Key("load_torque", "load", "N.m", "167 N.m",
        "torque at the output that opposes the motion (negative: the load drives); `\"50 %\"` is a share of the rated"
        " torque"),
    Key("temperature", "temperature", "K", "40 degC", "of the housing, when steady", 0, 0.0),
    Key("hours", "hours", "s", "1000 h", "operating hours of the unit when it was measured", 0, 0.0),
    Key(LOCKED_AT, LOCKED_AT, "rad", "90 deg",
        "angle of the input at which a loop, lost motion or stiffness was measured, positive forward; counted as the angles of the same mounting;"
        " `\"mean\"`: of positions over a turn of the cranks"),
    Key("normal_force", "normal_force", "N", "50 N", "pin-on-disc: force on the pin", 0, 0.0),
    Key("sliding_speed", "sliding_speed", "m/s", "0.1 m/s", "pin-on-disc: speed of the contact", 0, 0.0),
    Key("sliding_distance", "sliding_distance", "m", "1 km", "pin-on-disc: way of the contact", 0, 0.0),
)  # fmt: skip

TAGS = {
    tag.name: tag
    for tag in (
        Tag("surface", "which surface", ("flank", "pin", "inner_race", "outer_race")),
        Tag("disc", "number of the disc, from 1", counted="discs"),
        Tag("crank", "number of the crank, from 1", counted="cranks"),
        Tag("tooth", "number of the lobe or pin, from 1", counted="pins"),
        Tag("part", "what was weighed, for instance disc 1 or reducer"),
        Tag("location", "where the sensor sits, for instance housing_radial"),
        Tag("locked", "which side was held", ("input", "output")),
    )
}

# What was done to the unit before a condition; some effects differ in nothing but their answer to it.
INTERVENTIONS = {
    "grease_changed": "grease replaced by fresh grease",
    "encoder_turned": "output encoder turned against its shaft",
    "ring_turned": "ring turned against the housing by whole pins, or clamped anew",
    "planets_reindexed": "planets meshed anew, one tooth further",
    "pins_exchanged": "new pins with the worn discs",
    "load_reversed": "torque reversed after one-sided running",
}

RUNNING = ("speed", "load")
WORN_PLACE = ("disc", "crank", "tooth")

QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity("transmission_error", "rad", "arcsec",
                 "angle of the output less angle of the input over the ratio, referred to the output",
                 ("angle",), ("time",), RUNNING),
        Quantity("transmission_order", "rad", "arcsec",
                 "amplitude and phase of orders of the transmission error, or a curve over the angle from which they are made",
                 ("order", "phase"), (), RUNNING),
        Quantity("hysteresis", "rad", "arcmin", "turning of the output under torque, one side held, torque up and down",
                 ("torque",), ("time",), (), ("locked",)),
        Quantity("lost_motion", "rad", "arcmin", "turning between +3 % and -3 % of the rated torque, one side held"),
        Quantity("torsional_stiffness", "N.m/rad", "N.m/arcmin", "secant from half to full rated torque, input held"),
        Quantity("input_torque", "N.m", "N.m", "torque at the input", (), ("angle", "time"), RUNNING),
        Quantity("no_load_torque", "N.m", "N.m", "torque at the input without load", (), ("angle", "time"), ("speed",)),
        Quantity("efficiency", "1", "%", "power out over power in", (), (), RUNNING),
        Quantity("vibration", "m/s^2", "m/s^2", "acceleration of a housing point", ("time",), ("angle",), RUNNING,
                 ("location",)),
        Quantity("vibration_order", "m/s^2", "m/s^2", "amplitude (not rms) of the acceleration over order", ("order",), (),
                 RUNNING, ("location",)),
        Quantity("temperature", "K", "degC", "temperature over time", ("time",), (), RUNNING, ("location",)),
        Quantity("wear_profile", "m", "um", "depth worn off a surface, positive into the part", ("depth_angle",), (),
                 (*RUNNING, "hours"), ("surface",), WORN_PLACE),
        Quantity("wear_depth", "m", "um", "largest depth of a surface", (), (), (*RUNNING, "hours"), ("surface",),
                 WORN_PLACE),
        Quantity("mass_loss", "kg", "mg", "mass lost since new", (), (), (*RUNNING, "hours"), ("part",)),
        Quantity("debris_iron", "1", "ppm", "mass share of iron in the grease", (), (), (*RUNNING, "hours")),
        Quantity("cage_speed", "rad/s", "rpm", "speed of a roller cage against its disc", (), ("time",), RUNNING, (),
                 ("disc", "crank")),
        Quantity("pin_on_disc_depth", "m", "um", "depth worn in a pin-on-disc test", (), (),
                 ("normal_force", "sliding_speed", "sliding_distance")),
        Quantity("pin_on_disc_mass", "kg", "mg", "mass lost in a pin-on-disc test", (), (),
                 ("normal_force", "sliding_speed", "sliding_distance")),
        Quantity("pin_on_disc_friction", "1", "1", "friction force over normal force", (), (),
                 ("normal_force", "sliding_speed")),
    )
}  # fmt: skip

FACTOR_KEYS = {key.key: key for key in FACTORS}
FACTOR_NAMES = tuple(dict.fromkeys(key.name for key in FACTORS))


def roles_of(quantity: Quantity) -> dict[str, Key]:
    """Roles that columns of a run may take: the value, the axes and, row by row, the factors."""
    value = Key(VALUE, VALUE, quantity.unit, quantity.usual_unit, quantity.description)
    axes = {key.key: key for key in AXES if key.name in quantity.axes + quantity.optional_axes}
    return {VALUE: value} | axes | {name: key for name, key in FACTOR_KEYS.items() if key.name in numbers_of(quantity)}


def numbers_of(quantity: Quantity) -> tuple[str, ...]:
    """Names of a condition's numbers that can matter to a quantity: where the input was locked says nothing of a running reducer."""
    return tuple(name for name in FACTOR_NAMES if name != LOCKED_AT or quantity.name in HELD)


def keys_that_matter(quantity: Quantity) -> list[str]:
    """Keys of a condition that are asked for a quantity: what its model needs, and what holds for whatever is measured; a loop has neither speed nor load."""
    always = tuple(name for name in numbers_of(quantity) if name in ("temperature", "hours", LOCKED_AT))
    return [key.key for key in FACTORS if key.name in quantity.factors + always]


def keys_for(name: str) -> list[str]:
    """The keys that state an axis or a factor."""
    return [key.key for key in (*AXES, *FACTORS) if key.name == name]
