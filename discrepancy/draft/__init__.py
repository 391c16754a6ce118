"""Step 4: an effect file drafted from a law that was recovered without a name.

A recovered law says that a measured quantity lacks f(x).  A draft puts f where the unit takes something of that kind
(``places``), written in SI with parameters of its own (``expression``), as a file that a person would write (``write``).
Which law, and beside what, is chosen in ``choose``.  The file lies in DIR/rv_plant/ or DIR/wear_fmu/: named by the
environment variable RVWEAR_EFFECTS, DIR's effects are compiled into the units and found by the diagnosis.
"""
