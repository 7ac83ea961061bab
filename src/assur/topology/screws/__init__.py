"""The second route: chains placed in space, moved by finite amounts, and the ranks of their twists."""
