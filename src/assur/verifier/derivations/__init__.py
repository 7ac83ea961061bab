"""The check of derivations: formulas that solve the loop equations of a mechanism file, with an identity for each step.

`check` reads a derivation; `terms` are formulas in exact arithmetic, `turning` is what joints say of orientations,
`assembly` has the loops of the file; `branches` holds every branch against them modulo a prime.
"""
