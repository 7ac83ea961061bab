"""A mechanism as data: its file, the record that is read from it, and the joint graph."""
