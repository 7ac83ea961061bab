"""Closing blocks: the parts of a mechanism that close by themselves, and the signs by which they name its modes."""
