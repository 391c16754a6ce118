"""What hangs on the joint: gravity and friction of an arm; its inertia is the reducer's load.inertia."""

import math

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Arm(Fmi2Slave):
    """torque = gravity sin(angle) + friction tanh(speed/smooth_speed), against positive rotation."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.angle = self.speed = self.torque = 0.0
        self.gravity, self.friction, self.smooth_speed = 120.0, 6.0, 2e-3
        for name, causality in (("angle", Fmi2Causality.input), ("speed", Fmi2Causality.input),
                                ("torque", Fmi2Causality.output)):  # fmt: skip
            self.register_variable(Real(name, causality=causality))
        for name in ("gravity", "friction", "smooth_speed"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, current_time, step_size):
        self.torque = self.gravity * math.sin(self.angle) + self.friction * math.tanh(self.speed / self.smooth_speed)
        return True
