"""Model against measurement: compare, localise, diagnose, extend, propose the next experiment."""
