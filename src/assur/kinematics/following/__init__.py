"""From pose to pose, the mode kept: along a prescribed course, and over a grid of poses from neighbour to neighbour."""
