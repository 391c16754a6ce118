"""Kernels to machine code: a small compiler from a subset of Python to LLVM.

    source     a kernel's syntax tree and what its names mean
    types      what a value of a kernel can be: number, tuple, record, array
    function   a function of LLVM while it is written: its lines, blocks and variables
    names      what a name means: a variable, or something outside of the kernel
    elements   fields of records, elements and rows of arrays, items of tuples
    calls      calls of kernels, of ``math``, of builtin functions
    expressions, statements, loops   Python's syntax tree to LLVM code
    emitter    one function for given argument types, walked until its types have settled
    arithmetic numbers: operators and functions of ``math`` with Python's meaning
    module     an entry point with all it calls: one LLVM module, optimised, as object code
    assembly, c_source, c_function, c_expressions   the same LLVM text as C99
    store      object code on disk, private to its owner, checked before it is used
    loading    object code into this process
    calling    calls from Python

A kernel is written in: numbers, tuples, ``if``, ``for ... in range``, ``while``, fields of
records, elements and rows of arrays, ``math``, ``abs``, ``min``, ``max``, ``int``,
``float``, ``len`` and calls of other kernels.  Nothing allocates and nothing raises, so
what comes out needs the C library's ``libm`` and no more.  What the subset lacks is
refused with file, line and remedy.
"""
