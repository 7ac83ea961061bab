"""Answers from a closed form: branches of signs, roots of one polynomial, a polynomial system, sweeps of millions."""
