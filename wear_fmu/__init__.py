"""The wear accumulator: laws, surfaces, and the unit that drives them."""
