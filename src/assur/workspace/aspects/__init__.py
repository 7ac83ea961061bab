"""Aspects: the connected parts of a workspace in which no pose is singular, with proof."""
