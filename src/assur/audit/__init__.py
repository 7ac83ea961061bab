"""The audit: every number that a mechanism's source prints, beside the number that assur computes."""
