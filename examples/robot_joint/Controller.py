"""Position and speed controller of a joint, on the motor's side as robots have it."""

import math

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Controller(Fmi2Slave):
    """Moves 0, +reach, 0, -reach, 0 in smooth moves with pauses; gives the motor's current."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.motor_angle = self.current = self.target = 0.0
        self.ratio, self.reach, self.move_time, self.pause = 121.0, 0.5, 0.7, 0.3
        self.position_gain, self.speed_gain, self.reset_time = 40.0, 0.22, 0.03
        # Current per acceleration: all inertia at the motor over its torque constant.
        self.feedforward, self.largest_current = 8.8e-4, 12.0
        self.angle_before = self.integral = 0.0
        for name, causality in (("motor_angle", Fmi2Causality.input), ("current", Fmi2Causality.output),
                                ("target", Fmi2Causality.output)):  # fmt: skip
            self.register_variable(Real(name, causality=causality))
        for name in ("ratio", "reach", "move_time", "pause", "position_gain", "speed_gain", "reset_time", "feedforward",
                     "largest_current"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def trajectory(self, time):
        """(angle, speed, acceleration) of the flange: least jerk, then a pause."""
        stops = (0.0, self.reach, 0.0, -self.reach, 0.0)
        move, within = divmod(time, self.move_time + self.pause)
        start, end = (stops[min(int(move) + i, len(stops) - 1)] for i in (0, 1))
        s = min(within / self.move_time, 1.0)
        angle = start + (end - start) * s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
        speed = (end - start) * 30.0 * s * s * (1.0 - s) ** 2 / self.move_time
        return angle, speed, (end - start) * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / self.move_time**2

    def do_step(self, current_time, step_size):
        self.target, speed, acceleration = self.trajectory(current_time + step_size)
        motor_speed = (self.motor_angle - self.angle_before) / step_size
        self.angle_before = self.motor_angle
        wanted = self.ratio * speed + self.position_gain * (self.ratio * self.target - self.motor_angle)
        error = wanted - motor_speed
        current = self.speed_gain * (error + self.integral) + self.feedforward * self.ratio * acceleration
        self.current = math.copysign(min(abs(current), self.largest_current), current)
        # At the limit the integral waits, or it would overshoot afterwards.
        if current == self.current:
            self.integral += error * step_size / self.reset_time
        return True
