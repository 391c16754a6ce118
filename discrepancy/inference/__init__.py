"""Statistics of the comparison: knows records and predictions, neither files nor reducers.

``diagnose(model)`` answers which effect a model lacks; ``recover`` gives the law without a name
where no effect fits; ``next_experiment`` says what to measure to tell rivals apart.
"""
