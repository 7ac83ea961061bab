"""Type synthesis: which mechanisms have a wanted motion, without doubles, each one confirmed and ranked."""
