"""Export: a mechanism as a file that a simulator reads."""
