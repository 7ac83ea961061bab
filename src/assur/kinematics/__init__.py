"""Positions, velocities and loop closure of a mechanism, from its joint graph and its closed form."""
