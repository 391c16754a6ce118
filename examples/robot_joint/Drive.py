"""Current controller of the motor: the amplifier."""

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Drive(Fmi2Slave):
    """PI controller of the current with the voltage's limit."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.wanted = self.current = self.voltage = self.integral = 0.0
        self.gain, self.reset_time, self.largest_voltage = 2.0, 4e-3, 300.0
        for name, causality in (("wanted", Fmi2Causality.input), ("current", Fmi2Causality.input),
                                ("voltage", Fmi2Causality.output)):  # fmt: skip
            self.register_variable(Real(name, causality=causality))
        for name in ("gain", "reset_time", "largest_voltage"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, current_time, step_size):
        error = self.wanted - self.current
        self.integral += error * step_size / self.reset_time
        voltage = self.gain * (error + self.integral)
        self.voltage = max(-self.largest_voltage, min(self.largest_voltage, voltage))
        return True
