"""Workspaces with proof: boxes that lie inside, outside or about the boundary, and what follows from them."""
