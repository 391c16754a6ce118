"""Fuzzing of every reader: whatever a file holds, it is read rightly or refused with its name, the place and what to do.

    python3 build.py fuzz [minutes]         all readers in turn, from the seeds and the kept corpus

The property of each mutant: no other exception than InputFault (or RunFault), which names the file; no more than ten seconds of one core,
no more than 1 GiB of memory, no process that dies, nothing written elsewhere, nothing started.  Mutants that are refused with a message
of a new kind become seeds themselves: each refusal is a place in the code that was reached.  What once failed is kept in ``corpus``.
"""

from pathlib import Path

CORPUS = Path(__file__).with_name("corpus")
