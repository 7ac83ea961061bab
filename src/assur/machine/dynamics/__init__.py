"""Motions in time: prescribed ones, and those that forces bring about."""
