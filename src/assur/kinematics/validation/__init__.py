"""Whether a file is a mechanism that moves as it says: `assur check`."""
