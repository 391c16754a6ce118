"""Lines of campaign.toml that a text asks for, as what is typed, chosen or ticked under In: who works on the page writes no file."""

import re
from functools import partial

# What In has no field for keeps its line, and says so.
NO_FIELD = r"write \g<line> into campaign.toml,\g<where>, as In has no field for it"
# Longer ones first, for some begin alike.
LINES = [
    (r'state locked_at = "(?P<at>[^"]+)", the angle of the input, in the condition',
     r"type the angle of the input, such as \g<at>, as 'locked at' of the condition under In"),
    (r'state locked_at = "(?P<at>[^"]+)" in the condition', r"type \g<at> as 'locked at' of the condition under In"),
    (r'state locked_at = "mean"', r"type mean there"),
    (r"leave out locked_at\b", r"empty 'locked at' of the condition under In"),
    (r"\(locked_at of the condition\)", r"('locked at' of the condition)"),
    (r'state angle_of = "input" in \[quantities\.transmission_error\] of campaign\.toml', r"choose 'the input, over the ratio' as 'angle of' under In"),
    (r'angle_of = "input" in \[quantities\.transmission_error\] of campaign\.toml', r"'the input, over the ratio' as 'angle of' under In"),
    (r'angle_of = "output" is assumed', r"'an encoder on the output' is assumed as 'angle of'"),
    (r'angle_of = "output"', r"'angle of' is 'an encoder on the output' under In"),
    (r"state (?P<keys>[a-z_]+(?: or [a-z_]+)*) in \[conditions\.(?P<name>[^]]+)\], or give it as a column",
     r"type \g<keys> of condition \g<name> under In, or choose a column for it"),
    (r"correct (?P<keys>load_torque) in \[conditions\.(?P<name>[^]]+)\]", r"correct \g<keys> of condition \g<name> under In"),
    (r"state reducer in \[campaign\]", r"choose the reducer under In"),
    (r'state direction = "forward" or "reverse"', r"choose forward or reverse as 'direction' of the conditions under In ('a column for')"),
    (r'state direction = "reverse" if it turned that way; else scale = -1 in its column',
     r"choose reverse as 'direction' of the condition under In ('a column for') if it turned that way; else type -1 as the scale of its column there"),
    (r'measure with direction = "reverse" too', r"measure in reverse, too"),
    (r', and state mounting = "2"', r", and choose 'another one at each mounting' above the conditions under In: a column says which mounting each is of"),
    (r"stated as (?P<keys>[a-z_]+(?: or [a-z_]+)*)", r"typed as '\g<keys>' of the conditions under In ('a column for' where there is none)"),
    (r" \(replicate = 2\)", r""),
    (r"set held_out = true in", r"tick 'held out' under In of"),
    (r"leave held_out away in", r"untick 'held out' under In of"),
    (r"state scale = -1 in one of the two columns", r"type -1 as the scale of one of the two columns under In"),
    (r'state unit = (?P<units>"[^"]+"(?: or "[^"]+")*)(?: in its column)?', r"choose \g<units> as the unit of its column under In"),
    (r'state zero = "absolute" in \[quantities\.[a-z_]+\] or in the run', r"choose 'known: its mean counts' as 'zero' of its files under In"),
    (r'state (?P<line>noise = "\.\.\.")(?P<where> in (?:its|the) runs)', NO_FIELD),
    (r"state (?P<line>unwrap = true)(?P<where> in its column)", NO_FIELD),
]  # fmt: skip
PATTERNS = [(re.compile(pattern), told) for pattern, told in LINES]


def in_fields(text: str) -> str:
    """``text`` with what is done under In in place of each line of campaign.toml."""
    for pattern, told in PATTERNS:
        text = pattern.sub(partial(with_labels, told), text)
    return text


def with_labels(told: str, found: re.Match[str]) -> str:
    """Keys as the labels of their fields: "load torque"."""
    return found.expand(told.replace(r"\g<keys>", found.groupdict().get("keys", "").replace("_", " ")))
