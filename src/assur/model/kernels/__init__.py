"""Kernels read from a file's text: straight-line algebra, worked out by an evaluator of our own and never executed."""
