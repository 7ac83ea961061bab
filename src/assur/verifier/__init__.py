"""A small verifier of certificates that shares no code with what made them: read it in ten minutes, then trust it.

It imports nothing else of this project, only the standard library and python-flint.
"""
