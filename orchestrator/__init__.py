"""The master algorithm and what it steps: units in this process or as FMUs, and systems of them."""
