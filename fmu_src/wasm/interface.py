"""The draft's interface ``fmi:fmi3/co-simulation@3.0.0``: names and types, in its own words (WIT).

A type is a name of a plain type (``f64``) or of a named one (``status``), or a tuple of
a constructor and what it is made of: ``("list", "f64")``, ``("result", OK, ERROR)``.
"""

from typing import Any

PACKAGE = "fmi:fmi3/{}@3.0.0"
INSTANCE = "co-simulation-instance"

Type = Any

# The interface ``types``, in its order.
TYPES: dict[str, Type] = {
    "value-reference": "u32",
    "status": ("enum", "ok", "warning", "discard", "error", "fatal"),
    "fmu-state": ("list", "u8"),
    "interval-qualifier": ("enum", "interval-not-yet-known", "interval-unchanged", "interval-changed"),
    "interval-fraction": ("record", ("counter", "u64"), ("resolution", "u64")),
    "dependency-kind": ("enum", "dependent", "constant", "fixed", "tunable", "discrete"),
    "variable-dependency": (
        "record", ("dependent-value-reference", "value-reference"), ("element-index-of-dependent", "u32"),
        ("independent-value-reference", "value-reference"), ("element-index-of-independent", "u32"), ("kind", "dependency-kind"),
    ),
    "discrete-states-info": (
        "record", ("new-discrete-states-needed", "bool"), ("terminate-simulation", "bool"), ("nominals-of-continuous-states-changed", "bool"),
        ("values-of-continuous-states-changed", "bool"), ("next-event-time-defined", "bool"), ("next-event-time", "f64"),
    ),
}  # fmt: skip
# What the interface co-simulation uses of them, and has of its own.
USED = ("value-reference", "status", "fmu-state", "interval-qualifier", "interval-fraction", "variable-dependency", "discrete-states-info")
DO_STEP_RESULT: Type = (
    "record", ("last-successful-time", "f64"), ("event-handling-needed", "bool"), ("terminate-simulation", "bool"), ("early-return", "bool"),
)  # fmt: skip

REFERENCES = ("value-references", ("list", "value-reference"))
ORDERS = ("requests", ("list", ("tuple", "value-reference", "u32")))
SEEDS = (("unknowns", ("list", "value-reference")), ("knowns", ("list", "value-reference")), ("seed", ("list", "f64")))


def may_fail(kind: Type) -> Type:
    return ("result", kind, "status")


def listed(kind: Type) -> Type:
    return may_fail(("list", kind))


# Of the values of variables: name in the calls -> type.
VALUES: dict[str, Type] = {
    "float32": "f32", "float64": "f64", "int8": "s8", "int16": "s16", "int32": "s32", "int64": "s64", "uint8": "u8", "uint16": "u16",
    "uint32": "u32", "uint64": "u64", "boolean": "bool", "string": "string", "binary": ("list", "u8"), "clock": "bool",
}  # fmt: skip

# Methods of the instance: name -> (parameters after the instance, result).
METHODS: dict[str, tuple[tuple[tuple[str, Type], ...], Type]] = {
    "set-debug-logging": ((("logging-on", "bool"), ("categories", ("list", "string"))), "status"),
    "enter-initialization-mode": ((("tolerance", ("option", "f64")), ("start-time", "f64"), ("stop-time", ("option", "f64"))), "status"),
    "exit-initialization-mode": ((), "status"),
    "enter-event-mode": ((), "status"),
    "update-discrete-states": ((), may_fail("discrete-states-info")),
    "terminate": ((), "status"),
    "reset": ((), "status"),
    "enter-configuration-mode": ((), "status"),
    "exit-configuration-mode": ((), "status"),
    **{f"get-{name}": ((REFERENCES,), listed(kind)) for name, kind in VALUES.items()},
    **{f"set-{name}": ((REFERENCES, ("values", ("list", kind))), "status") for name, kind in VALUES.items()},
    "get-number-of-variable-dependencies": ((("vr", "value-reference"),), may_fail("u64")),
    "get-variable-dependencies": ((("dependent", "value-reference"),), listed("variable-dependency")),
    "get-fmu-state": ((), may_fail("fmu-state")),
    "set-fmu-state": ((("state", "fmu-state"),), "status"),
    "get-directional-derivative": (SEEDS, listed("f64")),
    "get-adjoint-derivative": (SEEDS, listed("f64")),
    "get-interval-decimal": ((REFERENCES,), listed(("tuple", "f64", "interval-qualifier"))),
    "get-interval-fraction": ((REFERENCES,), listed(("tuple", "interval-fraction", "interval-qualifier"))),
    "get-shift-decimal": ((REFERENCES,), listed("f64")),
    "get-shift-fraction": ((REFERENCES,), listed("interval-fraction")),
    "set-interval-decimal": ((REFERENCES, ("intervals", ("list", "f64"))), "status"),
    "set-interval-fraction": ((REFERENCES, ("intervals", ("list", "interval-fraction"))), "status"),
    "set-shift-decimal": ((REFERENCES, ("shifts", ("list", "f64"))), "status"),
    "set-shift-fraction": ((REFERENCES, ("shifts", ("list", "interval-fraction"))), "status"),
    "evaluate-discrete-states": ((), "status"),
    "set-input-derivatives": ((ORDERS, ("values", ("list", "f64"))), "status"),
    "get-output-derivatives": ((ORDERS,), listed("f64")),
    "do-step": (
        (("current-communication-point", "f64"), ("communication-step-size", "f64"), ("no-set-fmu-state-prior-to-current-point", "bool")),
        may_fail("do-step-result"),
    ),
    "enter-step-mode": ((), "status"),
}  # fmt: skip

INSTANTIATE: tuple[tuple[str, Type], ...] = (
    ("instance-name", "string"), ("instantiation-token", "string"), ("resource-path", "string"), ("visible", "bool"), ("logging-on", "bool"),
    ("event-mode-used", "bool"), ("early-return-allowed", "bool"), ("required-intermediate-variables", ("list", "value-reference")),
)  # fmt: skip
LOG_MESSAGE: tuple[tuple[str, Type], ...] = (("instance-name", "string"), ("status", "status"), ("category", "string"), ("message", "string"))
