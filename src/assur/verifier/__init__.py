"""A small verifier of certificates that shares no code with what made them: read it in an hour, then trust it.

`check`, `program`, `bounds` and `reading` prove leaf after leaf what follows from the formulas of a certificate;
`closure` holds these formulas against a joint graph of its own (`graph`, over `mechanism` and `formula`), at `places`
drawn in a prime `field`, with a bound on the error by `sizes`.

It imports nothing else of this project, only the standard library and python-flint.
"""
