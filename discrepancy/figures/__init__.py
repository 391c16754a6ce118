"""Key figures: what an engineer asks first (stiffness, lost motion, orders), and what chance makes of them."""
