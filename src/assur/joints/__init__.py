"""Joint types, one file each: what a joint is called, what it does to its child, how files and notations write it."""
