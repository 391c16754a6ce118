"""Other integrators than the plant's, on its own forces and tangent: error against work.

    python3 -m benchmarks.integrators [--reducer NAME ...] [--json FILE]

Two stretches of motion: a quarter crank turn at rated speed and load, and the load
reversed through clearance and backlash in 20 ms.  All methods start from the same state,
keep the same communication points and control their step by the same norm (a deflection
of 1 um times the tolerance).  The sun is a flywheel, so that no coordinate is prescribed.

The reference is SciPy's Radau (order 5) at a tolerance of 1e-5.  The
step methods here are meant for this comparison alone.
"""
