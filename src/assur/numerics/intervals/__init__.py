"""Intervals over arrays: bounds that hold whatever the rounding does."""
