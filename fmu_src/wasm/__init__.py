"""A unit as a WebAssembly component (draft layered standard FMI-LS-WASM).

    component.c    FMI 3.0's calls as the component model wants them
    interface      the draft's interface co-simulation: names and types of its functions
    encoding       the binary format of modules and components, as far as it is needed
    component      one component of the compiled unit
    linking        object code, shell and component.c to a core module
"""
