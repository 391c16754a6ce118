"""Units written out in Python, exact where it matters, to check the master against known solutions."""

from functools import cache

import numpy as np
from scipy.linalg import expm

from fmu_src.faults import RunFault
from orchestrator.component import Component, Signal


class PythonUnit(Component):
    """Values by reference in one array; ``inputs`` come first, then ``outputs``."""

    def __init__(self, name, inputs, outputs, units=None):
        self.name = name
        names = [*inputs, *outputs]
        units = units or {}
        self.signals = {
            n: Signal(n, "input" if n in inputs else "output", units.get(n, "1"), (i,), (), unit_given=n in units)
            for i, n in enumerate(names)
        }
        self.values = np.zeros(len(names))
        self.state = np.zeros(0)
        self.steps = 0

    def refresh(self):
        """Outputs from state and inputs."""

    def reader(self, references, buffer):
        index = np.array(references)

        def read():
            self.refresh()
            buffer[:] = self.values[index]

        return read

    def writer(self, references, buffer):
        index = np.array(references)

        def write():
            self.values[index] = buffer

        return write

    def enter_initialisation(self, start_time):
        pass

    def exit_initialisation(self):
        self.refresh()

    def step(self, time, duration):
        self.steps += 1

    def save(self):
        return np.concatenate([self.state, self.values]).tobytes()

    def restore(self, state):
        both = np.frombuffer(state)
        self.state, self.values = both[: self.state.size].copy(), both[self.state.size :].copy()


class Oscillator(PythonUnit):
    """x'' = -k x + c (u - x), exact for an input that is a polynomial of up to second degree."""

    def __init__(self, name, x, k=1.0, c=0.5, input_derivatives=0):
        super().__init__(name, ["u"], ["x", "v"])
        self.state = np.array([x, 0.0])
        self.input_derivatives = input_derivatives
        self.slopes = np.zeros(2)
        self.matrix = np.zeros((5, 5))
        self.matrix[0, 1] = self.matrix[2, 3] = self.matrix[3, 4] = 1.0
        self.matrix[1, 0], self.matrix[1, 2] = -(k + c), c
        self.transition = cache(lambda duration: expm(self.matrix * duration))

    def refresh(self):
        self.values[1:] = self.state

    def derivative_writer(self, references, order, buffer):
        def write():
            self.slopes[order - 1] = buffer[0]

        return write

    def step(self, time, duration):
        super().step(time, duration)
        self.state = (self.transition(duration) @ [*self.state, self.values[0], *self.slopes])[:2]


def modes(time, k=1.0, c=0.5):
    """x of two coupled oscillators that start at 1 and 0, at rest."""
    together, apart = 0.5 * np.cos(np.sqrt(k) * time), 0.5 * np.cos(np.sqrt(k + 2.0 * c) * time)
    return together + apart, together - apart


class Gain(PythonUnit):
    """y = slope u + offset at once, or any function of u: feedthrough."""

    def __init__(self, name, slope=1.0, offset=0.0, function=None):
        super().__init__(name, ["u"], ["y"])
        self.function = function or (lambda u: slope * u + offset)

    def feedthrough(self):
        return {("f8", 1): (("f8", 0),)}

    def refresh(self):
        self.values[1] = self.function(self.values[0])


class Shaft(PythonUnit):
    """Inertia driven by a torque and held by a spring and damper; gives its speed."""

    def __init__(self, name, inertia=1.0):
        super().__init__(name, ["torque"], ["speed"], {"torque": "N.m", "speed": "rad/s"})
        self.state = np.zeros(1)
        self.inertia = inertia

    def refresh(self):
        self.values[1] = self.state[0]

    def step(self, time, duration):
        # Speed decays with 1/s under a constant torque: exact.
        final = self.values[0] / self.inertia
        self.state[0] = final + (self.state[0] - final) * np.exp(-duration)


class Motor(PythonUnit):
    """Torque that grows from 1 N m as its shaft is held below 2 rad/s."""

    def __init__(self, name):
        super().__init__(name, ["speed"], ["torque"], {"torque": "N.m", "speed": "rad/s"})
        self.state = np.array([1.0])

    def refresh(self):
        self.values[1] = self.state[0]

    def step(self, time, duration):
        self.state[0] += duration * (2.0 - self.values[0])


class Fragile(Oscillator):
    """Fails in steps longer than ``longest``."""

    longest = 0.1

    def step(self, time, duration):
        if duration > self.longest:
            raise RunFault(f"{self.name} at time {time} s: no convergence")
        super().step(time, duration)
