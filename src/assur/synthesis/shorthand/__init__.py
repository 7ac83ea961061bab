"""Shorthand as titles of papers have it, 3-RPS or 2UPR-RPU, and the standard arrangements of axes that it means."""
