"""Statistics of the comparison: knows records and predictions, neither files nor reducers."""
