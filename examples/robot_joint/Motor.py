"""A permanent-magnet motor, seen as one winding; its rotor is part of the reducer's sun.inertia."""

import math

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Motor(Fmi2Slave):
    """L di/dt = u - R i - k omega, exact for a held voltage and speed; torque k i."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.voltage = self.angle = self.angle_before = self.current = self.torque = 0.0
        self.resistance, self.inductance, self.torque_constant = 0.6, 2.4e-3, 0.5
        for name, causality in (("voltage", Fmi2Causality.input), ("angle", Fmi2Causality.input),
                                ("current", Fmi2Causality.output), ("torque", Fmi2Causality.output)):  # fmt: skip
            self.register_variable(Real(name, causality=causality))
        for name in ("resistance", "inductance", "torque_constant"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, current_time, step_size):
        speed = (self.angle - self.angle_before) / step_size
        self.angle_before = self.angle
        rest = (self.voltage - self.torque_constant * speed) / self.resistance
        self.current = rest + (self.current - rest) * math.exp(-step_size * self.resistance / self.inductance)
        self.torque = self.torque_constant * self.current
        return True
