"""Which candidates would reduce the misfit more than noise does."""
