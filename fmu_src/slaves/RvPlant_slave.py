"""The class that pythonfmu finds in RvPlant.fmu."""

from fmu_src.slaves.kernel_slave import KernelSlave


class RvPlant(KernelSlave):
    """Equilibrium of the reducer; inputs, parameters and outputs as in the model description."""
