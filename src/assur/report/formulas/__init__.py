"""Formulas: kernels of a closed form read over recorded numbers, and written down as mathematics."""
