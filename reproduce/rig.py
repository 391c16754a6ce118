"""What the example of the rig of ratio 81 gave, kept: its data have no licence and do not come with this software.

``python examples/rv_reducer_te/answer.py orders.csv --splits 20`` on a clone of the data makes them anew; docs/real_data.md says how each was had.
(forward, backward), mean absolute error of the reconstructed curve on whole conditions that were used for nothing [arcsec].
"""

COMMAND = "python examples/rv_reducer_te/answer.py orders.csv --splits 20"
SUMMARY = "a public summary (GitHub, XiLab-Robotics/Physics-Informed-Neural-Networks, doc/reference_summaries, 2026)"
# Named physics with 20 numbers, mean and deviation over 20 other splits; a full quadratic of each order with 380, likewise.
PHYSICS, PHYSICS_SPREAD = (10.3, 10.1), (2.3, 5.8)
QUADRATIC, QUADRATIC_SPREAD = (11.8, 8.4), (2.7, 3.0)
# One split of 13 of 64 conditions: nothing fitted, and named physics.
NOTHING_FITTED, FITTED = (82.8, 154.3), (9.6, 4.1)
# Published: best learned model, best closed form.
LEARNED, CLOSED_FORM = (3.9, 8.6), (6.5, 7.1)
# Run-out of the encoder [arcsec]: named by the loop with its deviation, and as it is read off order 1.
RUN_OUT, RUN_OUT_DEVIATION, ORDER_1 = 61.7, 0.2, 61.9
# Springs in series beside the contacts [N m/arcmin], with both ends; the slope of the mean.
SPRINGS, SPRINGS_RANGE, SLOPE = 549.0, (539.0, 558.0), (430.0, 480.0)
