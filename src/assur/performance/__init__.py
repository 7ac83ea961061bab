"""Performance: how well a mechanism moves, point by point and over its workspace."""
