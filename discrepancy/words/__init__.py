"""How results are told: names, units, intervals, shapes, sentences."""
