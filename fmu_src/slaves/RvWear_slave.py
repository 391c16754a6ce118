"""The class that pythonfmu finds in RvWear.fmu."""

from fmu_src.slaves.kernel_slave import KernelSlave, add_reference

# pythonfmu runs this file anew for each instance and then drops a reference to its
# globals that it does not own; without one more the tenth or so would crash.
add_reference(globals())


class RvWear(KernelSlave):
    """Wear of flanks, pins and raceways; inputs, parameters and outputs as in the model description."""
