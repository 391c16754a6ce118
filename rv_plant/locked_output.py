"""Loop of input turning over torque with the output locked, friction of the drive included.

N elastic-slip elements lie beside the elastic drive and yield one after the other, see ``effects.drive_friction``.
"""

from fmu_src.kernel import kernel

ELEMENTS = 8
# Halvings of the range of turning when torque is given and turning is sought.
HALVINGS = 48


@kernel
def elastic_torque(turning, torques, phi):
    """Torque [N m] at a turning [rad], linear between the rising ``turning`` of a table."""
    low, high = 0, turning.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if turning[middle] > phi:
            high = middle
        else:
            low = middle
    width = turning[high] - turning[low]
    share = (phi - turning[low]) / width if width > 0.0 else 0.5
    return torques[low] + share * (torques[high] - torques[low])


@kernel
def locked_output_loop(turning, torques, applied, friction, share, presliding, sliders, found):
    """Fill ``found`` [rad] with the turning under ``applied`` torques [N m] in order, from the table of the elastic
    drive; ``sliders`` keep the elements' places."""
    n = sliders.shape[0]
    for i in range(applied.shape[0]):
        low, high = turning[0], turning[turning.shape[0] - 1]
        for _ in range(HALVINGS):
            phi = 0.5 * (low + high)
            held = elastic_torque(turning, torques, phi)
            most = (friction + share * abs(held)) / n
            for k in range(n):
                stretch = (phi - sliders[k]) / (2.0 * presliding * (k + 1.0) / n)
                held += most * min(max(stretch, -1.0), 1.0)
            if held > applied[i]:
                high = phi
            else:
                low = phi
        phi = 0.5 * (low + high)
        for k in range(n):
            longest = 2.0 * presliding * (k + 1.0) / n
            sliders[k] = min(max(sliders[k], phi - longest), phi + longest)
        found[i] = phi
