"""Kernels recorded once as straight-line programs, and what is made of them: fused compiled loops and derivatives."""
