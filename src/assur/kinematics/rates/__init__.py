"""Velocities and accelerations: the rows of closure at a pose, their ranks, Jacobians, the motion of a flat pose."""
