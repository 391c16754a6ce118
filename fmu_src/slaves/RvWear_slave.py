"""The class that pythonfmu finds in RvWear.fmu."""

from fmu_src.slaves.kernel_slave import KernelSlave


class RvWear(KernelSlave):
    """Wear of flanks, pins and raceways; inputs, parameters and outputs as in the model description."""
