"""Singularities: verdicts, examples of each kind, and the surfaces on which they lie."""
