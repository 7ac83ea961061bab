"""Solutions of the direct and the inverse problem that are proved by intervals, and where nothing could be proved."""
