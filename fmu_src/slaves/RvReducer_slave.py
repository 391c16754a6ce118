"""The class that pythonfmu finds in RvReducer.fmu."""

from fmu_src.slaves.kernel_slave import KernelSlave, add_reference

# pythonfmu runs this file anew for each instance and then drops a reference to its
# globals that it does not own; without one more the tenth or so would crash.
add_reference(globals())


class RvReducer(KernelSlave):
    """Motion and wear of the reducer; inputs, parameters and outputs as in the model description."""
