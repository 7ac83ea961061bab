"""Sections of the report: each one function that puts what an analysis found into kinds of result."""
