"""Many lives of one reducer whose parts, duty and parameters scatter."""
