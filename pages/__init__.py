"""How results look: one look, one template, one way to draw each kind of picture."""
