"""Cross-check: our numbers against those of another engine."""
