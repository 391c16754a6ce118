"""Every claim of the two source documents and of later literature, held against the computation.

    claims = judging.run(None, print)
    table.print_table(claims); page.write_page(claims, "results/reproduce.html"); table.as_json(claims)

``statements`` says what the claims are without loading what computes them, ``claim`` what a claim is, ``context`` runs what
several of them share, the modules ``*_claims`` hold the claims, ``printed_forms`` the formulas as printed; ``judging``
judges them, ``table`` and ``page`` show the outcome.  Equal code gives equal results, byte for byte.
"""
